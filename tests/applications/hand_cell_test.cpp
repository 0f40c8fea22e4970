// A hand on a keyboard, a mouse and a joystick moves an arm, in virtual time: what it gets is what it asked
// for, and nothing more once the thing in the hand is let go of or unplugged.
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstring>

#include "hal/operator/joystick/mock/mock_joystick.hpp"
#include "hal/operator/keyboard/mock/mock_keyboard.hpp"
#include "hal/operator/pointer/mock/mock_pointer.hpp"
#include "tests/applications/running.hpp"
#include "types/pose.hpp"

namespace flexrf::application {
extern const Application application;
}

namespace flexrf::whole {
namespace {

using std::chrono::milliseconds;

constexpr double rest = 1e-3;  // m: the sensors' noise
constexpr KeyEvent space{Key::character, ' '};
constexpr KeyEvent letter_w{Key::character, 'w'};

template <class Device>
Device& device(const char* name) {
  const Application& all = application::application;
  std::size_t i = 0;
  while (std::strcmp(all.devices[i].name, name) != 0) ++i;
  return static_cast<Device&>(*all.device_states[i].device);
}

struct Point {
  double x = 0, y = 0, z = 0;
};

/// Of the tool, as it was published last.
Point tool() {
  for (const SlotRecord& slot : application::application.slots) {
    if (std::strcmp(slot.name, "tool_pose") != 0) continue;
    if (slot.observer->newest() == nullptr) break;
    const auto& position = static_cast<const Pose*>(slot.observer->payload())->position;
    return {position[0], position[1], position[2]};
  }
  throw fixture::CheckFailed{"the tool's pose was never published"};
}

/// What a person does, and where the tool is afterwards. An application runs once in a process: each look at
/// it is a run of its own, the same up to there.
template <class Plan>
Point tool_after(Duration time, const Plan& plan) {
  int ends[2];
  CHECK(pipe(ends) == 0);
  const pid_t child = fork();
  if (child == 0) {
    Options options;
    options.virtual_time = time;
    options.realtime = false;
    options.status_view = false;
    options.hardware = {{"keyboard", "mock"}, {"mouse", "mock"}, {"joystick", "mock"}};
    Executive executive(application::application, options);
    const Status status = executive.prepare();
    if (!status) std::fprintf(stderr, "%s\n", status.cause());
    if (!status) _exit(1);
    plan();
    if (executive.run().exit_code != 0) _exit(2);
    const Point where = tool();
    _exit(write(ends[1], &where, sizeof(where)) == sizeof(where) ? 0 : 3);
  }
  close(ends[1]);
  Point where;
  const bool told = read(ends[0], &where, sizeof(where)) == sizeof(where);
  close(ends[0]);
  int status = 0;
  CHECK(waitpid(child, &status, 0) == child);
  CHECK(told && WIFEXITED(status) && WEXITSTATUS(status) == 0);
  return where;
}

double distance(const Point& a, const Point& b) {
  return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z);
}

void nothing() {}

void keys_move_it_while_the_dead_man_is_held() {
  const auto plan = [] {
    auto& keyboard = device<MockKeyboard>("keyboard");
    keyboard.plan(milliseconds(300), [](MockKeyboard& mock) { mock.hold(letter_w); });
    keyboard.plan(milliseconds(600), [](MockKeyboard& mock) { mock.let_go(letter_w); });
    keyboard.plan(milliseconds(700), [](MockKeyboard& mock) { mock.hold(space); });
    keyboard.plan(milliseconds(800), [](MockKeyboard& mock) { mock.hold(letter_w); });
    keyboard.plan(milliseconds(1800), [](MockKeyboard& mock) { mock.let_go(space); });
  };
  const Point begin = tool_after(milliseconds(200), nothing);
  CHECK(distance(tool_after(milliseconds(700), plan), begin) < rest);
  const Point end = tool_after(milliseconds(3000), plan);
  CHECK(std::abs(end.x - begin.x - 0.1) < 0.01);
  CHECK(std::hypot(end.y - begin.y, end.z - begin.z) < 2 * rest);
  CHECK(distance(tool_after(milliseconds(2500), plan), end) < rest);
}

void a_mouse_moves_it_as_far_as_its_counts() {
  const auto plan = [] {
    auto& mouse = device<MockPointer>("mouse");
    mouse.plan(milliseconds(200), [](MockPointer& mock) { mock.move(0, -10000); });
    mouse.plan(milliseconds(300), [](MockPointer& mock) { mock.press(0); });
    for (int i = 0; i < 100; ++i)
      mouse.plan(milliseconds(400 + 10 * i), [](MockPointer& mock) { mock.move(-10, 0); });
    mouse.plan(milliseconds(2500), [](MockPointer& mock) { mock.let_go(0); });
    mouse.plan(milliseconds(2600), [](MockPointer& mock) { mock.move(0, -10000); });
  };
  const Point begin = tool_after(milliseconds(200), nothing);
  const Point end = tool_after(milliseconds(4000), plan);
  CHECK(std::abs(end.y - begin.y - 0.05) < 0.005);  // 1000 counts of 50 um, to the left
  CHECK(std::hypot(end.x - begin.x, end.z - begin.z) < 2 * rest);
}

/// Deflected, and its dead-man button held; then pulled out, plugged in again and still held so.
void plan_for_the_joystick() {
  auto& joystick = device<MockJoystick>("joystick");
  joystick.plan(milliseconds(300), [](MockJoystick& mock) { mock.press(0); });
  joystick.plan(milliseconds(400), [](MockJoystick& mock) { mock.deflect(4, -1); });
}

void a_joystick_that_is_unplugged_stops_it() {
  const auto held = [] { plan_for_the_joystick(); };
  const auto unplugged = [] {
    plan_for_the_joystick();
    auto& joystick = device<MockJoystick>("joystick");
    joystick.plan(milliseconds(1400), [](MockJoystick& mock) { mock.unplug(); });
    joystick.plan(milliseconds(2500), [](MockJoystick& mock) {
      mock.plug_in();
      mock.press(0);
      mock.deflect(4, -1);
    });
  };
  const Point begin = tool_after(milliseconds(200), nothing);
  const Point at_that_time = tool_after(milliseconds(1400), unplugged);
  CHECK(at_that_time.z - begin.z > 0.05);
  const Point stopped = tool_after(milliseconds(2000), unplugged);
  CHECK(distance(stopped, at_that_time) < 0.02);  // 0.1 m/s, from which it comes to rest at 0.5 m/s^2
  CHECK(distance(tool_after(milliseconds(4000), unplugged), stopped) < rest);
  CHECK(tool_after(milliseconds(2000), held).z - stopped.z > 0.03);  // had it not been
}

}  // namespace
}  // namespace flexrf::whole

int main() {
  using namespace flexrf::whole;
  const CMUnitTest tests[] = {
      TEST_APART(keys_move_it_while_the_dead_man_is_held),
      TEST_APART(a_mouse_moves_it_as_far_as_its_counts),
      TEST_APART(a_joystick_that_is_unplugged_stops_it),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
