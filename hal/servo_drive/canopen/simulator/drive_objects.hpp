// The object dictionary of a simulated CiA 402 drive.
#pragma once

#include <array>
#include <optional>

#include "hal/canopen/pdo.hpp"
#include "hal/canopen/sdo_server.hpp"

namespace flexrf {

/// Numbers by their address, as an SDO server and PDOs read and write them.
class DriveObjects final : public canopen::ObjectDictionary {
 public:
  struct Object {
    canopen::ObjectAddress address;
    std::uint8_t size = 4;  ///< bytes
    bool writable = true;
    bool mappable = false;
    std::uint64_t first = 0;  ///< what it is after power-on
    std::uint64_t value = 0;
  };

  /// As a reset of the node finds them.
  DriveObjects();

  std::uint32_t read(canopen::ObjectAddress address, std::span<std::uint8_t> value,
                     std::size_t& size) override;
  std::uint32_t write(canopen::ObjectAddress address, std::span<const std::uint8_t> value) override;

  /// 0 when there is none.
  std::uint64_t get(canopen::ObjectAddress address) const;
  std::int64_t get_signed(canopen::ObjectAddress address) const;
  /// Whether or not others may write it.
  void set(canopen::ObjectAddress address, std::int64_t value);
  void set_first(canopen::ObjectAddress address, std::uint64_t value);
  /// Communication objects (index below 2000) only, or all.
  void reset(bool all);

  /// On purpose: mappings cannot be written.
  void fix_mapping() { fixed_mapping_ = true; }
  /// On purpose: writes of this object end with this abort code; 0 ends it.
  void refuse(canopen::ObjectAddress address, std::uint32_t code) {
    refused_ = address;
    refusal_ = code;
  }
  /// On purpose: it has no such object.
  void lack(canopen::ObjectAddress address);
  /// On purpose: it is in no PDO.
  void unmap(canopen::ObjectAddress address);
  /// On purpose: it refuses bit 30 in the identifiers of the PDOs that it sends.
  void refuse_bit_30() { refuses_bit_30_ = true; }
  /// Mappings are written only in pre-operational.
  void set_pre_operational(bool on) { pre_operational_ = on; }

  /// PDOs that it has in each direction.
  static constexpr std::uint16_t pdos = 2;
  /// As its objects say; `number` from 1 to pdos. Nothing: not in use, or none of its objects exists.
  std::optional<canopen::PdoPlan> pdo(canopen::PdoDirection direction, std::uint16_t number) const;

 private:
  /// count_ when there is none.
  std::size_t place_of(canopen::ObjectAddress address) const;
  /// Of a record, which tells it in its subindex 0; 0: there is no such record.
  std::uint8_t highest_subindex(std::uint16_t index) const;
  std::uint32_t code_of_missing(canopen::ObjectAddress address) const;
  Object* find(canopen::ObjectAddress address);
  const Object* find(canopen::ObjectAddress address) const;
  void add(canopen::ObjectAddress address, std::uint8_t size, bool writable, bool mappable,
           std::uint64_t first = 0);
  std::uint32_t check_mapping(canopen::ObjectAddress address, std::uint64_t value) const;

  static constexpr std::size_t capacity = 128;

  std::array<Object, capacity> objects_{};  // by their address
  std::size_t count_ = 0;
  bool fixed_mapping_ = false;
  bool refuses_bit_30_ = false;
  bool pre_operational_ = true;
  canopen::ObjectAddress refused_{};
  std::uint32_t refusal_ = 0;
};

}  // namespace flexrf
