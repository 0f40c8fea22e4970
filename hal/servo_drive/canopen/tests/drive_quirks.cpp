#include "hal/servo_drive/canopen/tests/drive_quirks.hpp"

#include <cstdio>
#include <initializer_list>
#include <memory>
#include <string_view>

#include "hal/can/in_process/in_process_can_bus.hpp"
#include "hal/driver/device_bench.hpp"
#include "hal/servo_drive/canopen/canopen_servo_drive.hpp"
#include "hal/servo_drive/canopen/simulator/drive_console.hpp"

// Its macros would not spare names of ours.
#include "tests/cmocka.hpp"

namespace flexrf {
namespace {

constexpr std::uint8_t odd_node = 5;

struct Quirk {
  std::initializer_list<const char*> drive;  // what the simulated drive is told
  const char* without;                       // what is read when the configuration says nothing of it
  void (*say)(CanopenServoDrive::Configuration&);
};

class QuirkCell {
 public:
  explicit QuirkCell(const Quirk& quirk, bool is_said) {
    auto& configuration = drive_->configuration();
    configuration.node = odd_node;
    configuration.increments_per_unit = 1000;
    if (is_said) quirk.say(configuration);
    ready_ = bus_->driver().initialise().is_ok() && drive_->driver().initialise().is_ok() &&
             bus_->driver().wire()->attach(far_end_) != nullptr;
    for (const char* line : quirk.drive) ready_ = far_end_.obey(line) == "ok" && ready_;
  }
  ~QuirkCell() {
    drive_->driver().stop();
    bus_->driver().wire()->detach(far_end_);
    bus_->driver().stop();
  }

  /// It comes up, follows to 1.1, and all is well.
  bool works() {
    return ready_ && runs_until([this] {
             const auto state = drive_->driver().state();
             return state && state->enabled && state->position > 1.099;
           });
  }
  bool fails_with(std::string_view part) {
    return ready_ && runs_until([this] { return !drive_->driver().fault().is_ok(); }) &&
           std::string_view(drive_->driver().fault().cause()).find(part) != std::string_view::npos;
  }
  const char* fault() { return drive_->driver().fault().cause(); }

 private:
  template <class Condition>
  bool runs_until(const Condition& is_so) {
    for (int i = 0; i < 1000; ++i) {
      bus_->receive(std::chrono::milliseconds(7));
      drive_->receive(std::chrono::milliseconds(7));
      if (is_so()) return true;
      drive_->driver().command_position(1.1);
      drive_->send();
      bus_->send();
    }
    return false;
  }

  std::unique_ptr<DeviceBench<InProcessCanBus>> bus_ =
      std::make_unique<DeviceBench<InProcessCanBus>>(nullptr);
  std::unique_ptr<DeviceBench<CanopenServoDrive>> drive_ = std::make_unique<DeviceBench<CanopenServoDrive>>(
      nullptr, std::span<QueueSink* const>{}, &bus_->driver());
  DriveConsole far_end_{{.node = odd_node, .first_position = 1000}, bus_->now()};
  bool ready_ = false;
};

bool is_a_matter_of_configuration(const Quirk& quirk) {
  QuirkCell unsaid{quirk, false};
  QuirkCell said{quirk, true};
  const bool good = unsaid.fails_with(quirk.without) && said.works();
  if (!good) std::printf("unsaid: %s; said: %s\n", unsaid.fault(), said.fault());
  return good;
}

using Said = CanopenServoDrive::Configuration;

void no_period(void**) {
  const bool good = is_a_matter_of_configuration({{"lack 60C2:01", "lack 60C2:02"},
                                                  "60C2:01 of node 5 was aborted",
                                                  [](Said& said) { said.tells_period = false; }});
  assert_true(good);
}
void no_abort_connection(void**) {
  const bool good =
      is_a_matter_of_configuration({{"lack 6007"}, "6007:00 of node 5 was aborted", [](Said& said) {
                                      said.tells_abort_connection = false;
                                    }});
  assert_true(good);
}
void no_supervision_of_ours(void**) {
  const bool good = is_a_matter_of_configuration(
      {{"lack 1016:01"}, "1016:01 of node 5 was aborted", [](Said& said) { said.supervises_us = false; }});
  assert_true(good);
}
void no_bit_30(void**) {
  const bool good = is_a_matter_of_configuration(
      {{"refuse bit 30"}, "1800:01 of node 5 was aborted", [](Said& said) { said.forbids_remote = false; }});
  assert_true(good);
}
void no_heartbeat(void**) {
  const bool good = is_a_matter_of_configuration(
      {{"lack 1017", "lack 1016:01"}, "1017:00 of node 5 was aborted", [](Said& said) {
         said.guarded = true;
         said.supervises_us = false;
       }});
  assert_true(good);
}
void no_mode_in_a_pdo(void**) {
  const bool good = is_a_matter_of_configuration({{"unmap 6060", "unmap 6061"},
                                                  "1600:03 of node 5 was aborted",
                                                  [](Said& said) { said.maps_mode = false; }});
  assert_true(good);
}

void no_velocity(void**) {
  const bool good = is_a_matter_of_configuration(
      {{"lack 606C"}, "`maps_velocity = false`", [](Said& said) { said.maps_velocity = false; }});
  assert_true(good);
}

}  // namespace

int run_drive_quirks() {
  const CMUnitTest tests[] = {
      {"no object for the period", no_period, nullptr, nullptr, nullptr},
      {"no abort connection option", no_abort_connection, nullptr, nullptr, nullptr},
      {"no supervision of our heartbeat", no_supervision_of_ours, nullptr, nullptr, nullptr},
      {"identifiers without bit 30", no_bit_30, nullptr, nullptr, nullptr},
      {"no heartbeat: node guarding", no_heartbeat, nullptr, nullptr, nullptr},
      {"a mode that is in no PDO", no_mode_in_a_pdo, nullptr, nullptr, nullptr},
      {"no velocity", no_velocity, nullptr, nullptr, nullptr},
  };
  return cmocka_run_group_tests_name("quirks are columns", tests, nullptr, nullptr);
}

}  // namespace flexrf
