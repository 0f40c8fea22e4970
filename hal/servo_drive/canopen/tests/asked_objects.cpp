#include "hal/servo_drive/canopen/tests/asked_objects.hpp"

#include <cstdio>
#include <cstring>
#include <memory>
#include <vector>

#include "hal/can/in_process/in_process_can_bus.hpp"
#include "hal/canopen/tests/listed_objects.hpp"
#include "hal/driver/device_bench.hpp"
#include "hal/servo_drive/canopen/canopen_servo_drive.hpp"
#include "hal/servo_drive/canopen/simulator/drive_console.hpp"
#include "places.hpp"

// Its macros would not spare names of ours.
#include "tests/cmocka.hpp"

namespace flexrf {
namespace {

constexpr std::uint8_t listed_node = 5;

bool asks_for_what_is_listed(ServoMode mode, bool has_all, bool interpolates) {
  const std::vector<ListedObject> rows = read_listed_objects(place::object_list);
  SdoListener listener{listed_node, rows};
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
