// Whatever comes between, in whatever order: what has to hold in each step holds, and afterwards all parts
// come into their bins.
#include <random>

#include "units/part_picker/tests/picker_world.hpp"

namespace flexrf::picker_random_test {
namespace {

using namespace flexrf;
using namespace flexrf::user;

class Disturber {
 public:
  Disturber(PickerWorld& world, std::uint32_t seed) : world_(world), random_(seed) {}

  /// In the next step; most things end by themselves.
  void disturb() {
    world_.may_move = !lasts(no_motion_);
    world_.tells_pose = !lasts(no_pose_);
    world_.sees = !lasts(blind_);
    world_.stop_requested = lasts(stopping_);
    world_.wishes.pick = !lasts(unwanted_);
    world_.is_stuck = lasts(stuck_);
    world_.is_led = lasts(led_);
    if (world_.is_led) world_.jog = drift_;
    if (world_.tip.z() + world_.jog.z() < 0.03) world_.jog.z() = 0;
    if (++quiet_ < next_) return;
    quiet_ = 0;
    next_ = 20 + static_cast<int>(random_() % 400);
    begin(static_cast<int>(random_() % 12));
  }
  /// Where there is room for it.
  void lay_another() {
    for (PickerWorld::Part& part : world_.parts)
      if (part.is_binned) part.is_there = false;
    const double x = any(0.34, 0.62);
    const double y = any(-0.22, 0.22);
    const bool has_room =
        std::none_of(world_.parts.begin(), world_.parts.end(), [&](const PickerWorld::Part& part) {
          return part.is_there && std::hypot(part.track.position[0] - x, part.track.position[1] - y) < 0.12;
        });
    if (has_room && world_.parts.size() < most_parts)
      world_.add(static_cast<std::uint16_t>(random_() % 4), x, y, any(-3, 3));
  }
  void end() {
    world_.may_move = true;
    world_.tells_pose = true;
    world_.sees = true;
    world_.stop_requested = false;
    world_.wishes.pick = true;
    world_.is_stuck = false;
    world_.is_led = false;
    for (PickerWorld::Part& part : world_.parts)
      if (part.track.found == VisualClass::obstacle) part.is_there = false;
  }

 private:
  static constexpr std::size_t most_parts = 50;  // obstacles among them

  static bool lasts(int& steps) { return steps > 0 && --steps >= 0; }
  double any(double from, double to) { return std::uniform_real_distribution<double>(from, to)(random_); }
  int some_steps(int most) { return 1 + static_cast<int>(random_() % static_cast<unsigned>(most)); }

  void begin(int what) {
    switch (what) {
      case 0:
        no_motion_ = some_steps(200);
        return;
      case 1:
        no_pose_ = some_steps(50);
        return;
      case 2:
        blind_ = some_steps(300);
        return;
      case 3:
        stopping_ = some_steps(200);
        return;
      case 4:
        unwanted_ = some_steps(400);
        return;
      case 5:
        stuck_ = some_steps(500);
        return;
      case 6:
        led_ = some_steps(150);
        drift_ = {any(-0.002, 0.002), any(-0.002, 0.002), any(-0.002, 0.002)};
        return;
      case 7:
        return push();
      case 8:
        if (PickerWorld::Part* const part = world_.target();
            part != nullptr && part != world_.held && world_.parts.size() < most_parts)
          world_.add_obstacle(part->track.position[0] + any(-0.08, 0.08),
                              part->track.position[1] + any(-0.08, 0.08));
        return;
      case 9:
        for (PickerWorld::Part& part : world_.parts)
          if (part.track.found == VisualClass::obstacle) part.is_there = false;
        return;
      case 10:
        if (random_() % 3 == 0) world_.take_from_hand();
        return;
      default:
        world_.steps_per_picture = some_steps(20);
        return;
    }
  }
  /// The part that it goes to, or any other.
  void push() {
    PickerWorld::Part* part = random_() % 2 == 0 ? world_.target() : nullptr;
    if (part == nullptr) part = &world_.parts[random_() % world_.parts.size()];
    if (part == world_.held || part->is_binned) return;
    const double way = random_() % 2 == 0 ? 0.006 : 0.08;
    part->track.position[0] = std::clamp(part->track.position[0] + any(-way, way), 0.32, 0.65);
    part->track.position[1] = std::clamp(part->track.position[1] + any(-way, way), -0.28, 0.28);
  }

  PickerWorld& world_;
  std::mt19937 random_;
  int quiet_ = 0;
  int next_ = 100;
  int no_motion_ = 0;
  int no_pose_ = 0;
  int blind_ = 0;
  int stopping_ = 0;
  int unwanted_ = 0;
  int stuck_ = 0;
  int led_ = 0;
  Eigen::Vector3d drift_ = Eigen::Vector3d::Zero();
};

bool random_disturbances_are_survived() {
  std::uint64_t interrupted = 0;
  std::uint64_t given_up = 0;
  std::uint64_t lost = 0;
  std::uint64_t binned = 0;
  for (std::uint32_t seed = 1; seed <= 60; ++seed) {
    PickerWorld world;
    world.lay_table();
    world.wishes.rest = std::chrono::seconds(2);
    Disturber disturber(world, seed);
    for (int i = 0; i < 10000 && world.is_well; ++i) {
      disturber.disturb();
      world.step();
      if (world.machine.state() == PickerState::waiting) disturber.lay_another();
    }
    disturber.end();
    if (!world.run(5)) {
      print_message("seed %u\n", seed);
      return false;
    }
    world.steps_per_picture = 5;
    if (!world.until(PickerState::waiting, 120)) {
      print_message("seed %u: %s (%s)\n", seed, name_of(world.machine.state()), world.machine.cause());
      return false;
    }
    const PickerMachine::Counters& counted = world.machine.counters();
    interrupted += world.interrupted;
    given_up += counted.given_up;
    lost += counted.lost_parts;
    binned += counted.binned;
    for (const PickerWorld::Part& part : world.parts) {
      const bool lies_there = part.is_there && !part.is_binned && part.track.found == VisualClass::target;
      if (!lies_there) continue;
      print_message("seed %u: one is left at %.3f, %.3f\n", seed, part.track.position[0],
                    part.track.position[1]);
      return false;
    }
  }
  // It was disturbed indeed.
  return interrupted > 75 && given_up > 15 && lost > 8 && binned > 150;
}

template <bool (*Run)()>
void passes(void**) {
  assert_true(Run());
}

}  // namespace
}  // namespace flexrf::picker_random_test

int main() {
  using namespace flexrf::picker_random_test;
  const CMUnitTest tests[] = {
      {"random disturbances", passes<random_disturbances_are_survived>, nullptr, nullptr, nullptr},
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
