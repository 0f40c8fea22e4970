// Electronic data sheets of CANopen devices (CiA 306), as their vendors write them; DCF files too.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "config-gen/model/diagnostics.hpp"

namespace flexrf::config_gen {

struct EdsNumber {
  std::int64_t value = 0;
  bool of_node = false;  // $NODEID is to be added
  Position position;
};

// A value or a limit that is no number.
struct EdsOddValue {
  std::string key;  // as "DefaultValue"
  std::string text;
  Position position;
};

// A variable: an object, or one of its subindices.
struct EdsVariable {
  std::string name;
  Position position;  // of its section
  std::optional<EdsNumber> data_type;
  std::string access;  // in small letters: ro, wo, rw, rwr, rww, const; empty: not said
  Position access_position;
  bool mappable = false;  // into PDOs
  Position mappable_position;
  std::optional<EdsNumber> value;  // of a DCF as configured, else the default
  bool configured = false;         // it is a DCF's
  std::optional<EdsNumber> low;
  std::optional<EdsNumber> high;
  std::vector<EdsOddValue> odd;    // which nobody can compare with anything
  std::optional<EdsNumber> flags;  // ObjFlags
};

// Bits of ObjFlags (CiA 306-1): by these a tool that configures the device leaves the object alone.
inline constexpr std::int64_t eds_refuses_writing = 1;
inline constexpr std::int64_t eds_refuses_reading = 2;

struct Eds {
  // By index and subindex; an object without subindices has 0.
  std::map<std::pair<std::uint16_t, std::uint8_t>, EdsVariable> variables;
  std::map<std::uint16_t, Position> objects;
  std::optional<EdsNumber> vendor;   // of [DeviceInfo]
  std::optional<EdsNumber> product;  // likewise
  std::optional<EdsNumber> node;     // of a DCF, [DeviceComissioning]

  const EdsVariable* find(std::uint16_t index, std::uint8_t subindex) const;
};

// Nothing when it is no EDS file at all, which is reported. What else is odd in it is a warning.
std::optional<Eds> read_eds(const std::filesystem::path& file, Diagnostics& diagnostics);
std::optional<Eds> parse_eds(std::string_view text, const std::filesystem::path& file,
                             Diagnostics& diagnostics);

// "u16", "i32", "f32"; "a text", "a domain" and the like for what is no number; "data type 0x0040" for what
// the standard does not know.
std::string eds_type_name(std::int64_t data_type);

}  // namespace flexrf::config_gen
