// What a node is to be asked and told by SDO before it is started, in order.
#pragma once

#include "hal/canopen/object.hpp"
#include "hal/canopen/pdo.hpp"

namespace flexrf::canopen {

struct ConfigurationStep {
  enum class Act : std::uint8_t {
    write,   ///< write `value`; what is refused has to be it already, and what cannot be written at all
             ///< `held`, under `mask`
    expect,  ///< read, and be equal to `value` under `mask`
    map,     ///< as write; refused by a node whose mapping is fixed: then what is there must be equal
    ask,     ///< read for Node::answered(); a refusal is no error
  };
  Act act = Act::write;
  std::uint8_t size = 4;  ///< bytes written: 1, 2 or 4
  ObjectAddress object{};
  std::uint32_t value = 0;
  std::uint32_t held = 0;
  std::uint32_t mask = 0xFFFFFFFF;
  const char* meaning = "";  ///< of what is expected, for a person: "vendor"
  bool optional = false;     ///< a node that has no such object does without it
  const char* helps = "";    ///< what a person may write into the table when it is refused; lives for ever
};

/// A list of bounded length; a step that no longer fits makes it incomplete, and then it is not used.
class Configuration {
 public:
  static constexpr std::size_t capacity = 96;

  /// `helps`: see ConfigurationStep.
  void write(ObjectAddress object, std::uint8_t size, std::uint32_t value, const char* helps = "") noexcept;
  /// Left out of a node that has no such object.
  void write_if_there(ObjectAddress object, std::uint8_t size, std::uint32_t value) noexcept;
  /// Reads the object, so that Node::answered() has its value.
  void ask(ObjectAddress object) noexcept;
  /// `meaning` outlives the configuration.
  void expect(ObjectAddress object, std::uint32_t value, std::uint32_t mask, const char* meaning) noexcept;
  /// Takes the PDO out of use, writes its mapping, how it is transmitted, and takes it into use: the order
  /// that CiA 301 prescribes, in pre-operational. An identifier that cannot be written is as good if it is
  /// the planned one already, and in use.
  void configure_pdo(const PdoPlan& plan) noexcept;

  bool is_complete() const noexcept { return complete_; }
  std::size_t size() const noexcept { return count_; }
  const ConfigurationStep& operator[](std::size_t index) const noexcept { return steps_[index]; }

 private:
  void add(const ConfigurationStep& step) noexcept;

  std::array<ConfigurationStep, capacity> steps_{};
  std::size_t count_ = 0;
  bool complete_ = true;
};

}  // namespace flexrf::canopen
