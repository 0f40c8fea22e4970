// SDO server (CiA 301): answers for a node's objects, in one piece or in segments. For simulated nodes.
#pragma once

#include <optional>
#include <span>

#include "hal/canopen/message.hpp"
#include "hal/canopen/object.hpp"

namespace flexrf::canopen {

/// A node's objects, as an SDO server reads and writes them.
class ObjectDictionary {
 public:
  virtual ~ObjectDictionary() = default;
  /// Puts the value into `value` and says its size; the abort code, or 0.
  virtual std::uint32_t read(ObjectAddress object, std::span<std::uint8_t> value, std::size_t& size) = 0;
  virtual std::uint32_t write(ObjectAddress object, std::span<const std::uint8_t> value) = 0;
};

class SdoServer {
 public:
  static constexpr std::size_t capacity = 256;  ///< bytes of a value

  /// The dictionary outlives the server.
  SdoServer(std::uint8_t node, ObjectDictionary& dictionary) noexcept
      : node_{node}, dictionary_{&dictionary} {}

  /// Of whichever message: the answer, if it is a request to this node that has one.
  std::optional<Message> receive(const Message& message) noexcept;

 private:
  enum class Open : std::uint8_t { nothing, read, write };

  Message answer(std::uint8_t command) const noexcept;
  Message abort(std::uint32_t code) noexcept;
  Message begin_read() noexcept;
  Message begin_write(const Message& message) noexcept;
  Message read_segment(const Message& message) noexcept;
  Message write_segment(const Message& message) noexcept;

  std::uint8_t node_;
  ObjectDictionary* dictionary_;
  Open open_ = Open::nothing;
  ObjectAddress object_{};
  bool toggle_ = false;
  std::size_t size_ = 0;
  std::size_t sent_ = 0;
  std::array<std::uint8_t, capacity> value_{};
};

}  // namespace flexrf::canopen
