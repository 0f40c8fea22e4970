// What a driver asks of a CANopen device's objects, as a list in CSV in its folder says; a device's EDS file
// is checked against it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "config-gen/model/position.hpp"

namespace flexrf::config_gen {

struct NeededObject {
  enum class Access {
    read,
    write,
    read_write,
    map,  // written; where it is fixed, it has to have the value already
  };
  enum class Pdo { none, received, sent };  // as the device sees it

  Position position;  // of its row
  std::uint16_t index = 0;
  std::uint8_t subindex = 0;
  std::string name;
  std::size_t type = 0;  // into object_types
  Access access = Access::read;
  Pdo pdo = Pdo::none;
  bool optional = false;
  // Asked for only if this parameter of the configuration is true, with `unless` if it is false, and with
  // `values` if it is one of them.
  struct Condition {
    std::string parameter;
    bool unless = false;
    std::vector<std::int64_t> values;
  };
  std::vector<Condition> when;  // all of them; none: always
  // What it has to be, or is set to: a number, or the parameter that says it.
  std::variant<std::monostate, std::int64_t, std::string> value;
  bool of_node = false;  // the number of the node is added to that number
  std::uint32_t mask = 0xFFFFFFFF;
  std::string without;  // it, what the drive cannot do
  std::string
      helps;  // what in the device's configuration is for drives that are otherwise: "maps_mode = false"
};

// The words of the list. Types by their number in CiA 301 beside.
inline const std::vector<std::string> object_types = {"i8", "i16", "i32", "u8", "u16", "u32", "bool"};
inline constexpr std::int64_t object_data_types[] = {2, 3, 4, 5, 6, 7, 1};
inline constexpr unsigned object_type_bits[] = {8, 16, 32, 8, 16, 32, 8};  // as SDO carries them
inline const std::vector<std::string> object_accesses = {"read", "write", "read_write", "map"};
inline const std::vector<std::string> object_pdos = {"received", "sent"};
inline const std::vector<std::string> object_presences = {"required", "optional"};

// "0x6040", "0x1018:01"; an object without subindices has none.
std::string object_text(std::uint16_t index, std::uint8_t subindex);

}  // namespace flexrf::config_gen
