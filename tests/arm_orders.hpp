// Whatever happens to an arm, in whatever order: it goes nowhere that nobody has asked for since the last
// Start. For each unit that leads one.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>

#include "hal/can/in_process/in_process_can_bus.hpp"
#include "hal/driver/device_bench.hpp"
#include "hal/robot_arm/mock/mock_arm.hpp"
#include "hal/robot_arm/of_drives/simulated/simulated_drive_arm.hpp"
#include "hal/robot_arm/simulated_melfa/simulated_melfa.hpp"
#include "six_axis.hpp"
#include "tests/cmocka.hpp"
#include "tests/event_orders.hpp"

namespace flexrf::arm_orders {

inline constexpr Duration cycle = std::chrono::milliseconds(7);

enum class Event : std::uint8_t {
  stop,
  start,
  silent,
  speaks,
  by_hand,
  target,
  other_target,
  made_safe,
  target_then_start,  // within one cycle
  idle,
  count
};
inline constexpr std::array<const char*, events_of<Event>> names{
    "stop",         "start",     "silent",
    "speaks",       "by hand",   "target",
    "other target", "made safe", "target then start",
    "idle"};

/// An arm, and what a person does to it beside giving Stop and Start.
class Arm {
 public:
  virtual ~Arm() = default;
  virtual RobotArm& arm() = 0;
  virtual void receive() = 0;
  virtual void send() = 0;
  /// It says nothing, or speaks again: its cable, or its power.
  virtual void be_silent(bool on) = 0;
  /// Somebody moves it by more than `far`, who could not if it resisted.
  virtual void be_moved() = 0;
  /// Cycles until it has done something or other.
  virtual int patience() const = 0;
  /// Farther than it goes while it stops, rad.
  virtual double far() const = 0;
};

class MockedArm final : public Arm {
 public:
  MockedArm() { assert_true(bench_.driver().initialise().is_ok()); }
  RobotArm& arm() override { return bench_.driver(); }
  void receive() override {
    bench_.receive(cycle);
    if (const auto state = bench_.driver().state()) at_ = *state;
  }
  void send() override { bench_.send(); }
  void be_silent(bool on) override {
    is_silent_ = on;
    bench_.driver().set_state(on ? std::nullopt : std::optional(at_));
  }
  void be_moved() override {
    if (bench_.driver().commanded()) return;
    at_.position[1] += at_.position[1] > 0.2 ? -0.4 : 0.4;
    be_silent(is_silent_);
  }
  int patience() const override { return 3; }
  double far() const override { return 1e-6; }

 private:
  DeviceBench<MockArm> bench_{&six_axis};
  JointState at_{};
  bool is_silent_ = false;
};

class MelfaArm final : public Arm {
 public:
  MelfaArm() { assert_true(bench_.driver().initialise().is_ok()); }
  RobotArm& arm() override { return bench_.driver(); }
  void receive() override { bench_.receive(cycle); }
  void send() override { bench_.send(); }
  void be_silent(bool on) override { bench_.driver().far_end().set_silent(on); }
  void be_moved() override {
    if (bench_.driver().far_end().controller().is_in_session()) return;
    way_ = -way_;
    bench_.driver().far_end().controller().be_led(way_);
  }
  int patience() const override { return 40; }
  double far() const override { return 0.05; }

 private:
  DeviceBench<SimulatedMelfa> bench_{&six_axis};
  double way_ = 0.2;
};

class ArmOfSimulatedDrives final : public Arm {
 public:
  ArmOfSimulatedDrives() {
    bench_.configuration().increments_per_unit.fill(100'000);
    bench_.configuration().homing_methods[5] = 35;  // at home where it is
    assert_true(bus_.driver().initialise().is_ok() && bench_.driver().initialise().is_ok());
  }
  ~ArmOfSimulatedDrives() override {
    bench_.driver().stop();
    bus_.driver().stop();
  }
  RobotArm& arm() override { return bench_.driver(); }
  void receive() override {
    bus_.receive(cycle);
    bench_.receive(cycle);
  }
  void send() override {
    bench_.send();
    bus_.send();
  }
  void be_silent(bool on) override {
    SimulatedCia402Drive& drive = bench_.driver().drive(1).far_end().drive();
    if (on) drive.power_off();
    if (!on && is_off_) drive.power_on(bench_.now());
    is_off_ = on;
  }
  void be_moved() override {
    way_ = -way_;
    bench_.driver().drive(1).far_end().drive().be_moved(way_);
  }
  int patience() const override { return 60; }
  double far() const override { return 0.05; }

 private:
  DeviceBench<InProcessCanBus> bus_{nullptr};
  DeviceBench<SimulatedDriveArm> bench_{&six_axis, {}, &bus_.driver()};
  double way_ = 20'000;
  bool is_off_ = false;
};

/// One of these arms, a unit that leads it, and what a person does to both. `Leader`: made of the arm, it has
/// step() for its unit, permit() for what the unit sees of the permission to move, and ask() for a motion, in
/// one of two ways.
template <class Leader>
class ArmWorld {
 public:
  explicit ArmWorld(std::unique_ptr<Arm> which) : held_(std::move(which)), leader_(held_->arm()) {
    permit(false);
    run(held_->patience());
  }

  void happens(Event event) {
    switch (event) {
      case Event::stop:
        permit(false);
        since_.reset();
        break;
      case Event::start:
      case Event::target_then_start:
        // Control refuses it until the thread had a cycle without.
        permit(false);
        run_unwatched(1);
        if (event == Event::target_then_start) leader_.ask(false);
        permit(true);
        since_ = held_->arm().state();
        is_said_safe_ = false;
        break;
      case Event::silent:
        held_->be_silent(true);
        break;
      case Event::speaks:
        held_->be_silent(false);
        break;
      case Event::by_hand:
        held_->be_moved();
        since_.reset();
        // Where it is now is told in the next cycles, unless it is silent.
        run_unwatched(2);
        break;
      case Event::target:
      case Event::other_target:
        leader_.ask(event == Event::other_target);
        is_wanted_ = is_wanted_ || (may_move_ && !is_said_safe_);
        break;
      case Event::made_safe:
        make_safe();
        break;
      default:
        break;
    }
    run(held_->patience());
  }
  void rest() { run(2 * held_->patience()); }

  const char* violation() const { return violation_; }
  int moved_as_asked() const { return moved_as_asked_; }

 private:
  void permit(bool on) {
    may_move_ = on;
    is_wanted_ = false;
    held_->arm().set_inhibited(!on);
    leader_.permit(on);
  }
  void make_safe() {
    is_wanted_ = false;
    for (int n = 0; n < 2 * held_->patience() && !is_said_safe_; ++n) {
      held_->receive();
      leader_.step();
      is_said_safe_ = held_->arm().make_safe();
      held_->send();
    }
    if (!is_said_safe_) run_unwatched(held_->patience());
    since_.reset();
  }
  void run_unwatched(int cycles) {
    for (int n = 0; n < cycles; ++n) {
      held_->receive();
      leader_.step();
      held_->send();
    }
  }
  void run(int cycles) {
    for (int n = 0; n < cycles; ++n) {
      run_unwatched(1);
      look();
    }
  }
  void look() {
    const auto state = held_->arm().state();
    if (!state) return;
    if (!since_) since_ = state;
    double moved = 0;
    for (std::size_t i = 0; i < six_axis.joint_count; ++i)
      moved = std::max(moved, std::abs(state->position[i] - since_->position[i]));
    if (moved <= held_->far()) return;
    if (is_wanted_) {
      ++moved_as_asked_;
    } else if (is_said_safe_) {
      violation_ = "it moved after it had said that it is safe";
    } else {
      violation_ = may_move_ ? "it moved where nobody had asked it to since the last Start"
                             : "it moved without the permission";
    }
  }

  std::unique_ptr<Arm> held_;
  Leader leader_;
  std::optional<JointState> since_;  // where it was at the last Start, or was moved to
  bool may_move_ = false;
  bool is_wanted_ = false;     // somebody has asked for a motion since the last Start
  bool is_said_safe_ = false;  // since then
  const char* violation_ = nullptr;
  int moved_as_asked_ = 0;
};

template <class Leader, class Which>
OrderOutcome outcome_of(std::span<const Event> order) {
  ArmWorld<Leader> world(std::make_unique<Which>());
  // It has led its arm somewhere already.
  for (const Event event : {Event::start, Event::target, Event::idle, Event::idle}) world.happens(event);
  for (const Event event : order) world.happens(event);
  world.rest();
  return {world.violation(), world.moved_as_asked()};
}

/// See hold_in_orders().
template <class Leader, class Which, std::size_t Length, std::size_t Long>
void no_order_moves_it(std::size_t some, std::size_t at_random) {
  const bool held = hold_in_orders<Event, Length, Long>(names, some, at_random, outcome_of<Leader, Which>);
  assert_true(held);
}

}  // namespace flexrf::arm_orders
