// A hand on a keyboard, a mouse and a joystick moves an arm in the guest: real drivers on devices that uinput
// makes. One that is unplugged in mid-motion stops it, and plugged in again moves it anew.
#include <cmath>
#include <cstdio>

#include "hal/operator/evdev/tests/evdev_descriptions.hpp"
#include "tests/applications/process.hpp"
#include "tests/applications/running.hpp"

namespace flexrf::application {
extern const Application application;
}

namespace flexrf::whole {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr double rest = 1e-3;             // m: the sensors' noise
constexpr double longest_way_out = 0.02;  // m: from 0.1 m/s it comes to rest at 0.5 m/s^2
constexpr double clearly_moved = 5e-3;    // m
constexpr auto longest_recovery = seconds(2);

void pause(milliseconds time) {
  std::this_thread::sleep_for(time);
}

/// What is held in it, and what moves the tool in the positive direction of an axis.
struct Hand {
  UinputDevice device;
  int dead_man;
  std::size_t axis;
  int type;
  int code;
  int moved;
  int at_rest;
};

/// Its axes are centred when it is plugged in.
UinputDescription centred_joystick() {
  return {.name = "flexrf test joystick",
          .keys = {BTN_TRIGGER, BTN_THUMB},
          .axes = {{ABS_X, -127, 127},
                   {ABS_Y, -127, 127},
                   {ABS_Z, -127, 127},
                   {ABS_RX, -127, 127},
                   {ABS_RY, -127, 127}}};
}

class HandCell {
 public:
  Hand& keyboard() { return keyboard_; }
  Hand& mouse() { return mouse_; }
  Hand& joystick() { return joystick_; }
  Running& running() { return running_; }

  double tool(std::size_t axis) { return running_.newest("tool_pose").at("position").at(axis).get<double>(); }

  /// Takes hold of it anew, and moves; as yet without letting go. False: the arm does not follow.
  bool is_moved_by(Hand& hand) {
    hand.device.report(hand.type, hand.code, hand.at_rest);
    hand.device.let_go(hand.dead_man);
    pause(milliseconds(60));
    hand.device.press(hand.dead_man);
    pause(milliseconds(60));
    const double before = tool(hand.axis);
    for (int n = 0; n < 30; ++n) {
      hand.device.report(hand.type, hand.code, hand.moved);
      pause(milliseconds(10));
    }
    return tool(hand.axis) - before > clearly_moved;
  }

 private:
  Options options() {
    std::string text =
        R"(<flexrf application="hand" format="1" descriptor="0123456789abcdef" checksum="edited">)";
    for (const char* name : {"keyboard", "mouse", "joystick"}) {
      text += std::string{"<device name=\""} + name +
              "\" driver=\"evdev\"><configuration><device>flexrf test " + name +
              "</device></configuration></device>";
    }
    write_file(folder_ / "cell.xml", text + "</flexrf>\n");
    Options options;
    options.configuration_file = folder_ / "cell.xml";
    return options;
  }

  Folder folder_;
  Hand keyboard_{UinputDevice{keyboard_description()}, KEY_SPACE, 0, EV_KEY, KEY_W, 1, 0};
  Hand mouse_{UinputDevice{pointer_description()}, BTN_LEFT, 1, EV_REL, REL_X, -10, 0};
  Hand joystick_{UinputDevice{centred_joystick()}, BTN_TRIGGER, 2, EV_ABS, ABS_RY, -127, 0};
  Running running_{application::application, options(), RightsOfATest::real_time};
};

template <Hand& (HandCell::*which)()>
void stops_when_unplugged_and_moves_again() {
  HandCell cell;
  Hand& hand = (cell.*which)();
  CHECK(wait_until([&] { return !cell.running().newest("tool_pose").is_null(); }));
  CHECK(wait_until([&] { return cell.is_moved_by(hand); }));
  const double unplugged_at = cell.tool(hand.axis);
  hand.device.unplug();
  pause(seconds(1));
  const double stopped_at = cell.tool(hand.axis);
  CHECK(stopped_at - unplugged_at < longest_way_out);
  pause(seconds(1));
  CHECK(std::abs(cell.tool(hand.axis) - stopped_at) < rest);
  CHECK(hand.device.plug_in());
  const Time since = MonotonicClock::now();
  while (!cell.is_moved_by(hand)) CHECK(MonotonicClock::now() - since < longest_recovery);
  const Duration recovery = MonotonicClock::now() - since;
  std::fprintf(stderr, "it moves again after %lld ms\n",
               static_cast<long long>(recovery.count() / 1'000'000));
  CHECK(recovery < longest_recovery);
  CHECK_EQUAL(cell.running().stop().exit_code, 0);
}

}  // namespace
}  // namespace flexrf::whole

int main() {
  using namespace flexrf::whole;
  const CMUnitTest tests[] = {
      TEST_APART(stops_when_unplugged_and_moves_again<&HandCell::keyboard>),
      TEST_APART(stops_when_unplugged_and_moves_again<&HandCell::mouse>),
      TEST_APART(stops_when_unplugged_and_moves_again<&HandCell::joystick>),
  };
  return cmocka_run_group_tests_name("an arm moved by hand, on real input devices", tests, nullptr, nullptr);
}
