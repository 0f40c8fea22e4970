// For tests of drivers: that what a master asks of a node is what its list of objects says, by which EDS
// files are checked.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include "hal/can/interface/can_node.hpp"
#include "hal/canopen/message.hpp"
#include "hal/canopen/object.hpp"

namespace flexrf {

struct ListedObject {
  canopen::ObjectAddress object;
  std::string type;
  std::string access;
  std::string pdo;
  std::string value;
};

inline std::uint32_t number_in(const std::string& text) {
  return static_cast<std::uint32_t>(std::strtoul(text.c_str(), nullptr, 0));
}

inline unsigned bits_of(const ListedObject& listed) {
  return listed.type == "bool" ? 8 : number_in(listed.type.substr(1));
}

/// Of lines without quotes. Empty: there is no such file.
inline std::vector<ListedObject> read_listed_objects(const char* file_name) {
  std::vector<ListedObject> rows;
  std::FILE* const file = std::fopen(file_name, "r");
  if (file == nullptr) return rows;
  char line[512];
  while (std::fgets(line, sizeof line, file) != nullptr) {
    std::vector<std::string> cells(1);
    for (const char c : std::string_view(line)) {
      if (c == ',') {
        cells.emplace_back();
      } else if (c != '\n') {
        cells.back() += c;
      }
    }
    if (cells.size() != 12 || cells[0] == "index") continue;
    rows.push_back(
        {{static_cast<std::uint16_t>(number_in(cells[0])), static_cast<std::uint8_t>(number_in(cells[1]))},
         cells[3],
         cells[4],
         cells[5],
         cells[8]});
  }
  std::fclose(file);
  return rows;
}

/// Hears what the master asks and tells a node by SDO, and says what is not so in the list.
class SdoListener final : public CanNode {
 public:
  SdoListener(std::uint8_t node, const std::vector<ListedObject>& rows) : node_{node}, rows_{rows} {}

  void on_frame(const CanFrame& frame, CanPort& /*port*/) noexcept override {
    if (frame.identifier != canopen::identifier_of(canopen::sdo_request_base, node_)) return;
    const std::uint8_t command = frame.data[0];
    const canopen::ObjectAddress object{
        static_cast<std::uint16_t>(canopen::read_number(frame.data.data() + 1, 2)), frame.data[3]};
    const auto value = static_cast<std::uint32_t>(canopen::read_number(frame.data.data() + 4, 4));
    const unsigned bits = 8U * (4U - (command >> 2 & 3U));
    ++asked_;
    if (command == 0x40 ? is_read(object) : is_written(object, bits, value)) return;
    std::printf("not in the list, or not so: %s of %04X:%02X, %u bits, %08X\n",
                command == 0x40 ? "read" : "write", unsigned{object.index}, unsigned{object.subindex}, bits,
                unsigned{value});
    ++missing_;
  }
  Time next_event() const noexcept override { return Time::max(); }
  void on_time(Time /*now*/, CanPort& /*port*/) noexcept override {}

  int asked() const { return asked_; }
  int missing() const { return missing_; }

 private:
  bool is_read(canopen::ObjectAddress object) const {
    for (const ListedObject& row : rows_) {
      if (row.object == object && row.access == "read") return true;
    }
    return false;
  }
  bool is_written(canopen::ObjectAddress object, unsigned bits, std::uint32_t value) const {
    for (const ListedObject& row : rows_) {
      if (row.object != object || bits_of(row) != bits) continue;
      if (row.access == "write") return true;
      if (row.access != "map") continue;
      const bool is_mapping = (object.index & 0xFF00U) == 0x1600 || (object.index & 0xFF00U) == 0x1A00;
      if (!is_mapping && is_value(row, bits, value)) return true;
      // The number of mapped objects is 0 while they are written, and may be a parameter's to say.
      const bool is_count = object.subindex == 0;
      const bool is_parameter = !row.value.empty() && row.value[0] >= 'a' && row.value[0] <= 'z';
      if (is_mapping && (number_in(row.value) == value || (is_count && (value == 0 || is_parameter))))
        return is_count || is_mapped(object, value);
    }
    return false;
  }
  // An identifier is written out of use first (bit 31), and may forbid remote frames (bit 30).
  bool is_value(const ListedObject& row, unsigned bits, std::uint32_t value) const {
    constexpr std::string_view of_node = "$NODEID+";
    if (row.value.starts_with(of_node))
      return (value & 0x3FFFFFFF) == number_in(row.value.substr(of_node.size())) + node_;
    return value == (number_in(row.value) & (bits < 32 ? (1U << bits) - 1 : 0xFFFFFFFF));
  }
  bool is_mapped(canopen::ObjectAddress mapping, std::uint32_t word) const {
    const canopen::ObjectAddress object{static_cast<std::uint16_t>(word >> 16),
                                        static_cast<std::uint8_t>(word >> 8)};
    for (const ListedObject& row : rows_) {
      if (row.object == object && bits_of(row) == (word & 0xFF) &&
          row.pdo == (mapping.index < 0x1800 ? "received" : "sent"))
        return true;
    }
    return false;
  }

  std::uint8_t node_;
  const std::vector<ListedObject>& rows_;
  int asked_ = 0;
  int missing_ = 0;
};

}  // namespace flexrf
