// The object dictionary of a simulated node.
#pragma once

#include <array>
#include <optional>

#include "hal/canopen/pdo.hpp"
#include "hal/canopen/sdo_server.hpp"

namespace flexrf::canopen {

/// Numbers by their address, as an SDO server and PDOs read and write them. The class of a node adds each
/// object that it has once, in its constructor, and then sorts them.
class SimulatedObjects : public ObjectDictionary {
 public:
  /// PDOs that it has in each direction.
  static constexpr std::uint16_t pdos = 2;

  std::uint32_t read(ObjectAddress address, std::span<std::uint8_t> value, std::size_t& size) override;
  std::uint32_t write(ObjectAddress address, std::span<const std::uint8_t> value) override;

  bool has(ObjectAddress address) const { return find(address) != nullptr; }
  /// 0 when there is none.
  std::uint64_t get(ObjectAddress address) const;
  std::int64_t get_signed(ObjectAddress address) const;
  /// Whether or not others may write it.
  void set(ObjectAddress address, std::int64_t value);
  void set_first(ObjectAddress address, std::uint64_t value);
  /// Communication objects (index below 2000) only, or all.
  void reset(bool all);

  /// On purpose: mappings cannot be written.
  void fix_mapping() { fixed_mapping_ = true; }
  /// On purpose: writes of this object end with this abort code; 0 ends it.
  void refuse(ObjectAddress address, std::uint32_t code) {
    refused_ = address;
    refusal_ = code;
  }
  /// On purpose: it has no such object.
  void lack(ObjectAddress address);
  /// On purpose: it is in no PDO.
  void unmap(ObjectAddress address);
  /// On purpose: it refuses bit 30 in the identifiers of the PDOs that it sends.
  void refuse_bit_30() { refuses_bit_30_ = true; }
  /// Mappings are written only in pre-operational.
  void set_pre_operational(bool on) { pre_operational_ = on; }

  /// As its objects say; `number` from 1 to pdos. Nothing: not in use, or none of its objects exists.
  std::optional<PdoPlan> pdo(PdoDirection direction, std::uint16_t number) const;

 protected:
  SimulatedObjects() = default;

  void add(ObjectAddress address, std::uint8_t size, bool writable, bool mappable, std::uint64_t first = 0);
  /// The parameters of all PDOs, none of them in use.
  void add_pdos();
  void sort();

 private:
  struct Object {
    ObjectAddress address;
    std::uint8_t size = 4;  ///< bytes
    bool writable = true;
    bool mappable = false;
    std::uint64_t first = 0;  ///< what it is after power-on
    std::uint64_t value = 0;
  };

  /// count_ when there is none.
  std::size_t place_of(ObjectAddress address) const;
  /// Of a record, which tells it in its subindex 0; 0: there is no such record.
  std::uint8_t highest_subindex(std::uint16_t index) const;
  std::uint32_t code_of_missing(ObjectAddress address) const;
  Object* find(ObjectAddress address);
  const Object* find(ObjectAddress address) const;
  std::uint32_t check_mapping(ObjectAddress address, std::uint64_t value) const;

  static constexpr std::size_t capacity = 160;

  std::array<Object, capacity> objects_{};  // by their address
  std::size_t count_ = 0;
  bool fixed_mapping_ = false;
  bool refuses_bit_30_ = false;
  bool pre_operational_ = true;
  ObjectAddress refused_{};
  std::uint32_t refusal_ = 0;
};

}  // namespace flexrf::canopen
