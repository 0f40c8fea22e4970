#include "hal/servo_drive/canopen/tests/asked_objects.hpp"

#include <memory>
#include <vector>

#include "hal/can/in_process/in_process_can_bus.hpp"
#include "hal/canopen/tests/data_sheet.hpp"
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

void data_sheet(void**) {
  DriveObjects objects;
  const bool good = is_as_data_sheet_says(objects, place::data_sheet, 40);
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
