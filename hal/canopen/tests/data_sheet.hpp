// For tests of simulated nodes: that they are as their data sheet (EDS) says.
#pragma once

#include <cstdio>
#include <cstring>

#include "hal/canopen/message.hpp"
#include "hal/canopen/sdo_server.hpp"
#include "hal/canopen/tests/listed_objects.hpp"

namespace flexrf {

/// Of the lines of an EDS file, what stands behind `key`; else null.
inline const char* value_of(const char* line, const char* key) {
  const std::size_t size = std::strlen(key);
  return std::strncmp(line, key, size) == 0 ? line + size : nullptr;
}

inline std::size_t bytes_of_data_type(std::uint32_t type) {
  switch (type) {
    case 1:
    case 2:
    case 5:
      return 1;
    case 3:
    case 6:
      return 2;
    default:
      return 4;
  }
}

/// Each object of the EDS file is there, with its size and what it is after power-on; there are more than
/// `least` of them.
inline bool is_as_data_sheet_says(canopen::ObjectDictionary& objects, const char* file_name, int least) {
  std::FILE* const file = std::fopen(file_name, "r");
  if (file == nullptr) return false;
  canopen::ObjectAddress address;
  std::size_t bytes = 0;
  int known = 0;
  bool good = true;
  char line[256];
  while (std::fgets(line, sizeof line, file) != nullptr) {
    unsigned index = 0;
    unsigned subindex = 0;
    if (line[0] == '[') {
      const int found = std::sscanf(line, "[%4x%*[sub]%x]", &index, &subindex);
      address = {static_cast<std::uint16_t>(found >= 1 ? index : 0U), static_cast<std::uint8_t>(subindex)};
    } else if (const char* type = value_of(line, "DataType=")) {
      bytes = bytes_of_data_type(number_in(type));
    } else if (value_of(line, "AccessType=") != nullptr) {
      std::uint8_t value[8] = {};
      std::size_t size = 0;
      good = good && objects.read(address, value, size) == 0 && size == bytes;
      ++known;
    } else if (const char* first = value_of(line, "DefaultValue="); first != nullptr && first[0] != '$') {
      const auto mask = bytes == 4 ? 0xFFFFFFFFU : (1U << (8 * bytes)) - 1;
      std::uint8_t value[8] = {};
      std::size_t size = 0;
      good = good && objects.read(address, value, size) == 0 &&
             canopen::read_number(value, size) == (number_in(first) & mask);
    }
    if (good) continue;
    std::printf("%04X:%02X is not as its data sheet says\n", unsigned{address.index},
                unsigned{address.subindex});
    break;
  }
  std::fclose(file);
  return good && known > least;
}

}  // namespace flexrf
