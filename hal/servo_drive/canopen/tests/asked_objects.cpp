#include "hal/servo_drive/canopen/tests/asked_objects.hpp"

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "hal/can/in_process/in_process_can_bus.hpp"
#include "hal/driver/device_bench.hpp"
#include "hal/servo_drive/canopen/canopen_servo_drive.hpp"
#include "hal/servo_drive/canopen/simulator/drive_console.hpp"
#include "places.hpp"

// Its macros would not spare names of ours.
#include "tests/cmocka.hpp"

namespace flexrf {
namespace {

constexpr std::uint8_t listed_node = 5;

struct Row {
  canopen::ObjectAddress object;
  std::string type;
  std::string access;
  std::string pdo;
  std::string value;
};

// Of a line without quotes, as all of this list are.
std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells(1);
  for (const char c : line) {
    if (c == ',') {
      cells.emplace_back();
    } else if (c != '\n') {
      cells.back() += c;
    }
  }
  return cells;
}

std::uint32_t number_in(const std::string& text) {
  return static_cast<std::uint32_t>(std::strtoul(text.c_str(), nullptr, 0));
}

std::vector<Row> read_list() {
  std::vector<Row> rows;
  std::FILE* const file = std::fopen(place::object_list, "r");
  if (file == nullptr) return rows;
  char line[512];
  while (std::fgets(line, sizeof line, file) != nullptr) {
    const std::vector<std::string> cells = cells_of(line);
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

unsigned bits_of(const Row& row) {
  return number_in(row.type.substr(1));
}

/// What the master asks and tells by SDO.
class Listener final : public CanNode {
 public:
  explicit Listener(const std::vector<Row>& rows) : rows_{rows} {}

  void on_frame(const CanFrame& frame, CanPort& /*port*/) noexcept override {
    if (frame.identifier != canopen::identifier_of(canopen::sdo_request_base, listed_node)) return;
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
    for (const Row& row : rows_) {
      if (row.object == object && row.access == "read") return true;
    }
    return false;
  }
  bool is_written(canopen::ObjectAddress object, unsigned bits, std::uint32_t value) const {
    for (const Row& row : rows_) {
      if (row.object != object || bits_of(row) != bits) continue;
      if (row.access == "write") return true;
      if (row.access != "map") continue;
      const bool is_mapping = (object.index & 0xFF00U) == 0x1600 || (object.index & 0xFF00U) == 0x1A00;
      if (!is_mapping && is_value(row, bits, value)) return true;
      // The number of mapped objects is 0 while they are written.
      if (is_mapping && (number_in(row.value) == value || (object.subindex == 0 && value == 0)))
        return object.subindex == 0 || is_mapped(object, value);
    }
    return false;
  }
  // An identifier is written out of use first (bit 31), and may forbid remote frames (bit 30).
  static bool is_value(const Row& row, unsigned bits, std::uint32_t value) {
    constexpr std::string_view of_node = "$NODEID+";
    if (row.value.starts_with(of_node))
      return (value & 0x3FFFFFFF) == number_in(row.value.substr(of_node.size())) + listed_node;
    return value == (number_in(row.value) & (bits < 32 ? (1U << bits) - 1 : 0xFFFFFFFF));
  }
  bool is_mapped(canopen::ObjectAddress mapping, std::uint32_t word) const {
    const canopen::ObjectAddress object{static_cast<std::uint16_t>(word >> 16),
                                        static_cast<std::uint8_t>(word >> 8)};
    for (const Row& row : rows_) {
      if (row.object == object && bits_of(row) == (word & 0xFF) &&
          row.pdo == (mapping.index < 0x1800 ? "received" : "sent"))
        return true;
    }
    return false;
  }

  const std::vector<Row>& rows_;
  int asked_ = 0;
  int missing_ = 0;
};

bool asks_for_what_is_listed(ServoMode mode, bool has_all, bool interpolates) {
  const std::vector<Row> rows = read_list();
  Listener listener{rows};
  const auto bus = std::make_unique<DeviceBench<InProcessCanBus>>(nullptr);
  const auto drive = std::make_unique<DeviceBench<CanopenServoDrive>>(nullptr, std::span<QueueSink* const>{},
                                                                      &bus->driver());
  drive->configuration().mode = mode;
  drive->configuration().node = listed_node;
  drive->configuration().vendor = 0x123;
  drive->configuration().product = 0x456;
  drive->configuration().homing_method = 35;
  drive->configuration().quick_stop_deceleration = 10;
  drive->configuration().guarded = !has_all;
  drive->configuration().maps_mode = has_all;
  drive->configuration().maps_speed = has_all;
  drive->configuration().maps_velocity = has_all;
  drive->configuration().interpolates = interpolates;
  DriveConsole far_end{{.node = listed_node}, bus->now()};
  if (!bus->driver().initialise() || !drive->driver().initialise()) return false;
  bus->driver().wire()->attach(far_end);
  bus->driver().wire()->attach(listener);
  bool enabled = false;
  for (int i = 0; i < 1000 && !enabled; ++i) {
    bus->receive(std::chrono::milliseconds(7));
    drive->receive(std::chrono::milliseconds(7));
    drive->send();
    bus->send();
    const auto state = drive->driver().state();
    enabled = state && state->enabled;
  }
  drive->driver().stop();
  bus->driver().wire()->detach(listener);
  bus->driver().wire()->detach(far_end);
  bus->driver().stop();
  return enabled && listener.asked() > 20 && listener.missing() == 0;
}

template <ServoMode Mode, bool HasAll = true, bool Interpolates = false>
void judged_in(void**) {
  const bool good = asks_for_what_is_listed(Mode, HasAll, Interpolates);
  assert_true(good);
}

// Of the lines of an EDS file, what stands behind `key`; else null.
const char* value_of(const char* line, const char* key) {
  const std::size_t size = std::strlen(key);
  return std::strncmp(line, key, size) == 0 ? line + size : nullptr;
}

std::size_t bytes_of_data_type(std::uint32_t type) {
  switch (type) {
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

// Each object of its EDS file, with its size and what it is after power-on.
bool simulated_drive_is_as_its_data_sheet_says() {
  std::FILE* const file = std::fopen(place::data_sheet, "r");
  if (file == nullptr) return false;
  DriveObjects objects;
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
  return good && known > 40;
}

void data_sheet(void**) {
  const bool good = simulated_drive_is_as_its_data_sheet_says();
  assert_true(good);
}

}  // namespace

int run_asked_objects() {
  const CMUnitTest tests[] = {
      {"in mode cyclic position", judged_in<ServoMode::cyclic_position>, nullptr, nullptr, nullptr},
      {"in mode cyclic velocity", judged_in<ServoMode::cyclic_velocity>, nullptr, nullptr, nullptr},
      {"in mode profile position", judged_in<ServoMode::profile_position>, nullptr, nullptr, nullptr},
      {"in mode profile velocity", judged_in<ServoMode::profile_velocity>, nullptr, nullptr, nullptr},
      {"guarded, and its mode in no PDO", judged_in<ServoMode::cyclic_position, false>, nullptr, nullptr,
       nullptr},
      {"guarded, and its mode and speed in no PDO", judged_in<ServoMode::profile_position, false>, nullptr,
       nullptr, nullptr},
      {"interpolated positions", judged_in<ServoMode::cyclic_position, true, true>, nullptr, nullptr,
       nullptr},
      {"the simulated drive is as its data sheet says", data_sheet, nullptr, nullptr, nullptr},
  };
  return cmocka_run_group_tests_name("the driver asks for what its list of objects says", tests, nullptr,
                                     nullptr);
}

}  // namespace flexrf
