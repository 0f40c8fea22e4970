// What comes between, at each stage: nothing may move, the camera tells nothing, a person leads the arm or
// wants it to wait, all has to stop, the gripper has trouble.
#include <cstring>

#include "units/part_picker/tests/picker_world.hpp"

namespace flexrf::picker_interference_test {
namespace {

using namespace flexrf;
using namespace flexrf::user;
using enum PickerState;

constexpr PickerState stages[] = {retreating, surveying, waiting,  approaching, looking,  descending,
                                  closing,    lifting,   carrying, lowering,    releasing};

/// Something happens at a stage, early in it or later; afterwards all parts come into their bins.
bool at_each_stage(bool (*disturb)(PickerWorld&, PickerState)) {
  for (const PickerState stage : stages) {
    for (const double late : {0.0, 0.07, 0.2}) {
      PickerWorld world;
      world.lay_table();
      if (!world.until(stage, 60)) return false;
      if (!world.run(late)) return false;
      const std::size_t lost = world.machine.counters().lost_parts;
      const PickerState at = world.machine.state();
      if (!disturb(world, at)) {
        print_message("at %s, %.2f s late: %s\n", name_of(stage), late, name_of(world.machine.state()));
        return false;
      }
      // Where the arm is led away while fingers close or open, they do not tell what became of the part.
      const bool is_sure = at != closing && at != releasing;
      if (is_sure && world.machine.counters().lost_parts != lost) return false;
      if (!world.goes_on(4)) {
        print_message("after %s, %.2f s late: %s, %zu binned\n", name_of(stage), late,
                      name_of(world.machine.state()), world.parts_binned());
        return false;
      }
    }
  }
  return true;
}

/// Neither target nor act, for a second.
bool rests_in(PickerWorld& world, PickerState state) {
  for (int i = 0; i < 150; ++i) {
    world.step();
    if (world.machine.state() != state || world.machine.target() || world.machine.act() != PickerAct::none)
      return false;
  }
  return world.is_well;
}

bool nothing_moves_when_nothing_may() {
  return at_each_stage([](PickerWorld& world, PickerState) {
    world.may_move = false;
    const bool rests = rests_in(world, off) && world.machine.is_at_rest();
    world.may_move = true;
    return rests;
  });
}

bool an_arm_that_does_not_say_where_it_is_rests() {
  return at_each_stage([](PickerWorld& world, PickerState) {
    world.tells_pose = false;
    const bool rests = rests_in(world, off);
    world.tells_pose = true;
    return rests;
  });
}

/// Fingers finish what they are at; the arm holds.
bool without_sight_the_arm_holds() {
  return at_each_stage([](PickerWorld& world, PickerState) {
    world.sees = false;
    bool holds = true;
    for (int i = 0; i < 300; ++i) {
      world.step();
      holds = holds && !world.machine.target();
    }
    holds = holds && world.machine.state() == no_sight && world.is_well;
    world.sees = true;
    return holds;
  });
}

/// Something may have been laid there meanwhile.
bool after_it_was_blind_the_whole_table_is_looked_at() {
  return at_each_stage([](PickerWorld& world, PickerState stage) {
    world.sees = false;
    if (!world.run(2)) return false;
    const bool has_part = world.machine.holds_part();
    world.states.clear();
    world.sees = true;
    if (!world.run(3) || has_part || stage == releasing || stage == closing) return world.is_well;
    const auto next = std::find_if(world.states.begin(), world.states.end(),
                                   [](PickerState state) { return state != retreating; });
    return next != world.states.end() && *next == surveying;
  });
}

/// Low and to the side, as hands do; it begins anew with a look at the whole table.
bool what_a_hand_leads_is_left_to_it() {
  return at_each_stage([](PickerWorld& world, PickerState stage) {
    world.is_led = true;
    for (int i = 0; i < 100; ++i) {
      world.jog = Eigen::Vector3d(world.tip.x() > 0.45 ? -0.002 : 0.0, world.tip.y() > 0 ? -0.002 : 0.002,
                                  world.tip.z() > 0.06 ? -0.003 : 0.0);
      world.step();
      if (world.machine.state() != led_by_others || world.machine.target()) return false;
    }
    world.is_led = false;
    const bool has_part = world.machine.holds_part();
    world.states.clear();
    if (!world.run(0.4) || world.machine.state() != led_by_others) return false;
    if (!world.run(3) || has_part || stage == releasing || stage == closing) return world.is_well;
    return world.states.size() > 1 && world.states[0] == retreating && world.states[1] == surveying;
  });
}

/// What is in hand, or about to be, is brought away first; nothing new is begun.
bool picking_that_is_switched_off_ends_in_order() {
  return at_each_stage([](PickerWorld& world, PickerState stage) {
    const bool finishes = stage == descending || stage == closing || world.machine.holds_part();
    const std::uint64_t begun = world.machine.counters().approaches;
    const std::uint64_t binned = world.machine.counters().binned;
    world.wishes.pick = false;
    if (!world.until(paused, 10) || world.machine.counters().approaches != begun) return false;
    if (world.machine.counters().binned != binned + (finishes ? 1 : 0)) return false;
    const bool rests = rests_in(world, paused) && world.machine.is_at_rest();
    world.wishes.pick = true;
    return rests;
  });
}

bool a_stop_is_heeded_at_once() {
  return at_each_stage([](PickerWorld& world, PickerState) {
    world.stop_requested = true;
    const bool rests = rests_in(world, paused) && world.machine.is_at_rest();
    world.stop_requested = false;
    return rests;
  });
}

/// At each instant of the release: the part is counted once, by where it came to lie.
bool an_interrupted_release_is_resolved_by_looking() {
  constexpr void (*disturb[])(PickerWorld&, bool) = {
      [](PickerWorld& world, bool on) { world.may_move = !on; },
      [](PickerWorld& world, bool on) { world.tells_pose = !on; },
      [](PickerWorld& world, bool on) { world.stop_requested = on; },
      [](PickerWorld& world, bool on) { world.is_led = on; },
  };
  std::size_t looked = 0;
  for (const auto between : disturb) {
    for (double late = 0; late < 0.3; late += seconds(control_cycle)) {
      PickerWorld world;
      world.add(0, 0.42, -0.15, 0.4);
      if (!world.until(releasing, 60) || !world.run(late)) return false;
      between(world, true);
      if (!world.run(0.3)) return false;
      between(world, false);
      for (int i = 0; i < 1500 && !world.machine.is_in_doubt(); ++i) world.step();
      if (world.machine.is_in_doubt()) ++looked;
      if (!world.goes_on(1)) return false;
      const PickerMachine::Counters& counted = world.machine.counters();
      if (counted.binned == 1 && counted.lost_parts == 0 && !world.machine.is_in_doubt()) continue;
      print_message("%.3f s late: binned %zu, lost %zu\n", late, static_cast<std::size_t>(counted.binned),
                    static_cast<std::size_t>(counted.lost_parts));
      return false;
    }
  }
  return looked > 20;
}

/// Led away while the fingers opened: what fell beside the bin is lost, and taken once more.
bool what_fell_beside_the_bin_is_lost() {
  PickerWorld world;
  world.add(0, 0.42, -0.15, 0.4);
  if (!world.until(releasing)) return false;
  world.is_led = true;
  const Eigen::Vector3d aside = (Eigen::Vector3d(0.42, -0.15, world.tip.z()) - world.tip) / 10;
  for (int i = 0; i < 10; ++i) {
    world.fingers.halt();
    world.jog = aside;
    world.step();
  }
  if (world.held == nullptr) return false;
  world.allow_drop();
  world.fingers.go({.opening = 0.085});
  if (!world.run(0.6)) return false;
  world.is_led = false;
  for (int i = 0; i < 3000 && world.machine.counters().lost_parts == 0; ++i) world.step();
  return world.machine.counters().lost_parts == 1 && world.machine.counters().binned == 0 && world.goes_on(1);
}

/// A gripper need not measure where its fingers are between its ends.
bool fingers_that_do_not_tell_their_opening_let_go() {
  PickerWorld world;
  world.tells_opening = false;
  world.lay_table();
  return world.goes_on(4);
}

/// They rest before they have let go: it says so, and opens them again.
bool fingers_that_do_not_open_are_told() {
  PickerWorld world;
  world.add(0, 0.42, -0.15, 0.4);
  if (!world.until(releasing)) return false;
  world.step();
  for (int i = 0; i < 100; ++i) {
    world.fingers.halt();
    world.step();
  }
  if (world.machine.state() != releasing || *world.machine.cause() == '\0') return false;
  return world.machine.counters().binned == 0 && world.goes_on(1);
}

/// Whoever moved it meanwhile: from there it goes straight up, and looks at the whole table anew.
bool led_while_it_is_paused() {
  PickerWorld world;
  world.lay_table();
  if (!world.until(looking)) return false;
  world.wishes.pick = false;
  world.step();
  world.is_led = true;
  for (int i = 0; i < 50; ++i) {
    world.jog = {0.001, -0.003, -0.001};
    world.step();
  }
  world.is_led = false;
  world.run(1);
  world.wishes.pick = true;
  world.states.clear();
  if (!world.run(3) || world.states.size() < 2 || world.states[0] != retreating) return false;
  return world.states[1] == surveying && world.goes_on(4);
}

/// Nobody but a person has it let go; switching over and back, and leading the arm, is no such wish.
bool what_it_did_not_take_it_does_not_drop() {
  PickerWorld world;
  PickerWorld::Part& part = world.add(1, 0.35, 0.1);
  world.lay_table();
  world.tip = {0.35, 0.1, 0.01};
  world.fingers.begin({.whose = "the test's", .open_width = 0.085, .speed = 0.15});
  part.width = 0.04;
  world.fingers.go({.opening = 0});
  for (int i = 0; i < 200; ++i) {
    world.may_move = false;
    world.now += control_cycle;
    world.fingers.fingers().put_object(0.04);
    world.fingers.advance(control_cycle);
  }
  world.may_move = true;
  if (!world.until(unknown_in_hand, 0.1) || !rests_in(world, unknown_in_hand)) return false;
  if (!world.machine.is_at_rest()) return false;
  world.wishes.pick = false;
  world.run(0.5);
  world.wishes.pick = true;
  if (!world.until(unknown_in_hand, 0.1) || !rests_in(world, unknown_in_hand)) return false;
  world.is_led = true;
  world.run(0.5);
  world.is_led = false;
  world.run(0.6);
  if (!world.until(unknown_in_hand, 0.1) || !rests_in(world, unknown_in_hand)) return false;
  world.wishes.open_gripper = true;
  world.step();
  if (world.machine.act() != PickerAct::open) return false;
  return world.goes_on(5);
}

/// It reports a fault; a press activates it, which may drop what it holds.
bool a_gripper_that_tripped_is_activated_by_a_person() {
  return at_each_stage([](PickerWorld& world, PickerState) {
    world.fingers.set_fault(FingerControl::Fault::tripped);
    if (!rests_in(world, gripper_trouble) || !world.machine.is_at_rest()) return false;
    world.wishes.open_gripper = true;
    world.step();
    return world.machine.act() == PickerAct::activate && world.is_well;
  });
}

/// The fingers did not come to rest in their time: it stays activated, and goes on when it is told again.
bool fingers_that_were_stuck_go_on_after_a_press() {
  PickerWorld world;
  world.lay_table();
  if (!world.until(closing)) return false;
  world.fingers.set_fault(FingerControl::Fault::stuck);
  if (!world.until(gripper_trouble, 4) || !rests_in(world, gripper_trouble)) return false;
  world.fingers.set_fault(FingerControl::Fault::none);
  world.wishes.open_gripper = true;
  if (!world.run(0.5) || world.machine.state() == gripper_trouble) return false;
  return world.goes_on(4);
}

/// Its power comes back without a trouble that is left: nobody but a person has it drop what it holds.
bool a_gripper_that_forgot_is_not_activated_around_a_part() {
  PickerWorld world;
  world.lay_table();
  if (!world.until(carrying)) return false;
  world.fingers.set_fault(FingerControl::Fault::off);
  if (!world.until(off, 0.1) || !rests_in(world, off)) return false;
  world.fingers.set_fault(FingerControl::Fault::none);
  for (int i = 0; i < 150; ++i) {
    world.step();
    if (world.machine.act() != PickerAct::none || world.machine.target()) return false;
  }
  if (world.machine.state() != off || !world.machine.holds_part()) return false;
  world.wishes.open_gripper = true;
  world.step();
  return world.machine.act() == PickerAct::activate && world.goes_on(4);
}

/// With a part in hand, by hand: it stays there, says why, and goes on when it is led out.
bool led_into_a_keep_out_it_says_so() {
  KeepOut stand{};
  stand.from = {0.62, -0.20, 0};
  stand.to = {0.72, -0.10, 0.5};
  const KeepOut boxes[] = {stand};
  PickerPlan plan = usual_plan();
  plan.keep_outs = boxes;
  PickerWorld world(plan);
  world.add(0, 0.38, 0.1);
  const auto lead_to = [&](const Eigen::Vector3d& place) {
    world.is_led = true;
    for (int i = 0; i < 100; ++i) {
      world.jog = (place - world.tip) * 0.1;
      world.step();
    }
    world.is_led = false;
  };
  if (!world.until(carrying)) return false;
  lead_to({0.65, -0.15, 0.12});
  if (!world.run(5) || world.machine.state() != blocked || !world.machine.holds_part()) return false;
  if (std::strstr(world.machine.cause(), "by hand") == nullptr || !world.machine.is_at_rest()) return false;
  if ((world.tip.head<2>() - Eigen::Vector2d(0.65, -0.15)).norm() > 1e-3) return false;
  lead_to({0.45, -0.1, 0.12});
  return world.goes_on(1) && world.machine.counters().approaches == 1;
}

template <bool (*Run)()>
void passes(void**) {
  assert_true(Run());
}

}  // namespace
}  // namespace flexrf::picker_interference_test

int main() {
  using namespace flexrf::picker_interference_test;
  const CMUnitTest tests[] = {
      {"nothing may move", passes<nothing_moves_when_nothing_may>, nullptr, nullptr, nullptr},
      {"no pose", passes<an_arm_that_does_not_say_where_it_is_rests>, nullptr, nullptr, nullptr},
      {"no sight", passes<without_sight_the_arm_holds>, nullptr, nullptr, nullptr},
      {"after no sight", passes<after_it_was_blind_the_whole_table_is_looked_at>, nullptr, nullptr, nullptr},
      {"led by a hand", passes<what_a_hand_leads_is_left_to_it>, nullptr, nullptr, nullptr},
      {"switched off", passes<picking_that_is_switched_off_ends_in_order>, nullptr, nullptr, nullptr},
      {"a stop is requested", passes<a_stop_is_heeded_at_once>, nullptr, nullptr, nullptr},
      {"an interrupted release", passes<an_interrupted_release_is_resolved_by_looking>, nullptr, nullptr,
       nullptr},
      {"fallen beside the bin", passes<what_fell_beside_the_bin_is_lost>, nullptr, nullptr, nullptr},
      {"the opening is not told", passes<fingers_that_do_not_tell_their_opening_let_go>, nullptr, nullptr,
       nullptr},
      {"fingers do not open", passes<fingers_that_do_not_open_are_told>, nullptr, nullptr, nullptr},
      {"led while paused", passes<led_while_it_is_paused>, nullptr, nullptr, nullptr},
      {"unknown in hand", passes<what_it_did_not_take_it_does_not_drop>, nullptr, nullptr, nullptr},
      {"the gripper tripped", passes<a_gripper_that_tripped_is_activated_by_a_person>, nullptr, nullptr,
       nullptr},
      {"the fingers were stuck", passes<fingers_that_were_stuck_go_on_after_a_press>, nullptr, nullptr,
       nullptr},
      {"the gripper forgot", passes<a_gripper_that_forgot_is_not_activated_around_a_part>, nullptr, nullptr,
       nullptr},
      {"led into a keep-out", passes<led_into_a_keep_out_it_says_so>, nullptr, nullptr, nullptr},
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
