// The driver `canopen` and a drive that others built: what the driver says of it, in its fault and in the
// log.
#include <cstring>
#include <vector>

#include "hal/can/in_process/in_process_can_bus.hpp"
#include "hal/can/interface/can_node.hpp"
#include "hal/canopen/can_message.hpp"
#include "hal/driver/device_bench.hpp"
#include "hal/servo_drive/canopen/canopen_servo_drive.hpp"
#include "hal/servo_drive/canopen/simulator/tests/foreign_drive.hpp"
#include "tests/cmocka.hpp"
#include "tests/log_ear.hpp"

namespace {

using namespace flexrf;
using canopen::Message;
using canopen::Outbox;
using std::chrono::milliseconds;

constexpr int cycle_of_7_ms = 7;

class ForeignOnCan final : public CanNode {
 public:
  ForeignOnCan(const ForeignDrive::Nature& nature, Time now) : drive_{nature}, now_{now} {}
  void on_frame(const CanFrame& frame, CanPort& port) noexcept override {
    if (!frame.extended) drive_.receive(canopen::to_message(frame), says_);
    say(port);
  }
  Time next_event() const noexcept override { return now_ + milliseconds(1); }
  void on_time(Time now, CanPort& port) noexcept override {
    now_ = now;
    drive_.step(says_);
    say(port);
  }
  ForeignDrive& drive() { return drive_; }

 private:
  void say(CanPort& port) noexcept {
    for (; !says_.is_empty(); says_.pop()) port.send(canopen::to_frame(says_.front()));
  }

  ForeignDrive drive_;
  Outbox says_;
  Time now_;
};

// The driver of a foreign drive in mode profile_position.
class DriverCell {
 public:
  explicit DriverCell(bool tells_speed, const ForeignDrive::Nature& nature = {},
                      std::int16_t quick_stop_option = 0)
      : nature_{nature} {
    auto& configuration = driver_.configuration();
    configuration.mode = ServoMode::profile_position;
    configuration.node = 5;
    configuration.lowest = -10;
    configuration.highest = 10;
    configuration.fastest = 5;
    configuration.tells_speed = tells_speed;
    configuration.quick_stop_option = quick_stop_option;
    good_ = bus_.driver().initialise().is_ok() && driver_.driver().initialise().is_ok() &&
            bus_.driver().wire()->attach(far_end_) != nullptr;
  }
  ~DriverCell() {
    driver_.driver().stop();
    bus_.driver().wire()->detach(far_end_);
    bus_.driver().stop();
  }

  CanopenServoDrive& drive() { return driver_.driver(); }
  ForeignDrive& far_end() { return far_end_.drive(); }
  void run(int ms) {
    for (int i = 0; i < ms; i += cycle_of_7_ms) {
      bus_.receive(milliseconds(cycle_of_7_ms));
      driver_.receive(milliseconds(cycle_of_7_ms));
      driver_.send();
      bus_.send();
    }
  }
  bool comes_up() {
    for (int i = 0; i < 1000 && drive().fault().is_ok() && !is_enabled(); ++i) run(cycle_of_7_ms);
    return good_ && is_enabled();
  }
  bool goes_to(double place, double speed) {
    drive().move_to(place, speed);
    for (int i = 0; i < 2000 && drive().fault().is_ok(); ++i) {
      run(cycle_of_7_ms);
      if (drive().state() && drive().state()->target_reached) return true;
    }
    print_message("fault: %s\n", drive().fault().cause());
    return false;
  }

 private:
  bool is_enabled() { return drive().state() && drive().state()->enabled; }

  ForeignDrive::Nature nature_;
  DeviceBench<InProcessCanBus> bus_{nullptr};
  DeviceBench<CanopenServoDrive> driver_{nullptr, {}, &bus_.driver()};
  ForeignOnCan far_end_{nature_, bus_.now()};
  bool good_ = false;
};

// Its drive has no following error window, and says nothing.
bool a_stuck_one_is_a_fault(bool tells_speed, double way) {
  DriverCell cell{tells_speed};
  if (!cell.comes_up() || !cell.goes_to(2, 0.5) || !cell.goes_to(-1, 5)) return false;
  if (way < 0) {
    cell.drive().move_to(-1 + way, 2);
    cell.run(300);
  }
  cell.far_end().stick();
  if (way > 0) cell.drive().move_to(-1 + way, 2);
  cell.run(2500);
  const Status& fault = cell.drive().fault();
  if (std::strstr(fault.cause(), "from its target") != nullptr &&
      std::strstr(fault.cause(), "does it stick, or does its encoder?") != nullptr &&
      !cell.far_end().is_enabled())
    return true;
  print_message("fault: %s\n", fault.cause());
  return false;
}

// The driver says it in the log, each time that the drive was brought up by it and not in each cycle.
bool own_ramps_are_told(bool has_own) {
  const LogEar ear;
  std::vector<std::uint32_t> lacks;
  if (has_own) lacks = {0x608300, 0x608400};
  DriverCell cell{true, {.lacks = lacks}};
  return cell.comes_up() && cell.goes_to(2, 5) && ear.has_heard("its ramps are its own") == has_own;
}

// Unless it is told what to do instead.
bool a_coasting_quick_stop_is_told(std::int16_t option) {
  const LogEar ear;
  DriverCell cell{true, {.quick_stop_option = 0}, option};
  return cell.comes_up() && ear.has_heard("the axis coasts") == (option == 0) &&
         cell.far_end().object(0x605A) == static_cast<std::uint32_t>(option);
}

void that_a_quick_stop_coasts_stands_in_the_log(void**) {
  for (const std::int16_t option : {std::int16_t{0}, std::int16_t{2}}) {
    const bool good = a_coasting_quick_stop_is_told(option);
    assert_true(good);
  }
}

void that_ramps_are_the_drives_own_stands_in_the_log(void**) {
  for (const bool has_own : {true, false}) {
    const bool good = own_ramps_are_told(has_own);
    assert_true(good);
  }
}

void an_axis_that_sticks_on_its_way_is_a_fault_where_the_drive_does_not_notice(void**) {
  for (const bool tells_speed : {true, false}) {
    for (const double way : {5.0, 0.2, -6.0}) {
      const bool good = a_stuck_one_is_a_fault(tells_speed, way);
      assert_true(good);
    }
  }
}

// Why it does not come nearer, the drive may know.
void an_axis_that_does_not_come_nearer_is_told_with_what_its_drive_says(void**) {
  struct Case {
    std::uint16_t bits;
    std::uint16_t never;
    const char* words;
  };
  for (const Case& one :
       {Case{0, 0x0200, "does not obey the bus"}, Case{0x0800, 0, "a limit of its own holds it"},
        Case{0x2000, 0, "that it cannot follow"}, Case{0x0400, 0, "beyond its own window (object 6067)"}}) {
    DriverCell cell{true};
    assert_true(cell.comes_up());
    cell.far_end().stick();
    cell.far_end().say_beside(one.bits, one.never);
    cell.drive().move_to(2, 2);
    cell.run(2500);
    if (std::strstr(cell.drive().fault().cause(), one.words) == nullptr)
      print_message("fault: %s\n", cell.drive().fault().cause());
    assert_non_null(std::strstr(cell.drive().fault().cause(), one.words));
  }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(that_ramps_are_the_drives_own_stands_in_the_log),
      cmocka_unit_test(that_a_quick_stop_coasts_stands_in_the_log),
      cmocka_unit_test(an_axis_that_sticks_on_its_way_is_a_fault_where_the_drive_does_not_notice),
      cmocka_unit_test(an_axis_that_does_not_come_nearer_is_told_with_what_its_drive_says),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
