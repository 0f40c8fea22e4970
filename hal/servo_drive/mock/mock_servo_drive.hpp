// MockServoDrive: is where its set-points are by the next cycle, and records what is commanded.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "hal/driver/mock/mock_delay.hpp"
#include "hal/driver/mock/mock_noise.hpp"
#include "hal/servo_drive/interface/range_end.hpp"
#include "hal/servo_drive/interface/servo_drive.hpp"
#include "hal/servo_drive/interface/servo_restraints.hpp"
#include "mock_servo_drive_driver.hpp"
#include "motion/set_point_follower.hpp"

namespace flexrf {

/// Enabled a cycle after it may move, without inertia; its home is at 0. Tests call it between cycles, from
/// the thread the drive lives in.
class MockServoDrive final : public MockServoDriveDriver {
 public:
  Status initialise() override {
    state_ = ServoState{};
    set_point_ = way_ = 0;
    constexpr double no_end = std::numeric_limits<double>::infinity();
    const bool endless = configuration.endless;
    follower_ = SetPointFollower{{.lowest = endless ? -no_end : configuration.lowest,
                                  .highest = endless ? no_end : configuration.highest,
                                  .velocity = configuration.fastest,
                                  .acceleration = configuration.acceleration}};
    forget();
    homing_ = ServoHoming::not_homed;
    homing_problem_ = {};
    last_cycle_ = Time{};
    noise_.seed(environment().seed);
    delay_.clear();
    measure();
    tell();
    return {};
  }

  std::optional<ServoState> state() const noexcept override {
    std::optional<ServoState> told = state_;
    if (told) {
      told->position = measured_.position;
      told->velocity = measured_.velocity;
      told->measured_at = measured_.at;
    }
    return told;
  }

  const Status& homing_problem() const noexcept override { return homing_problem_; }
  void halt() noexcept override {
    if (!may_follow()) return;
    ++halts_;
    forget();
    end_homing("the homing was halted");
    tell();
  }

  // ---- for tests

  /// Nothing: the drive is not heard.
  void set_state(const std::optional<ServoState>& state) noexcept {
    state_ = state;
    if (state) {
      homing_ = state->homing;
      set_point_ = way_ = state->position;
    }
    measure();
    tell();
  }
  /// Position and velocity are told so much later. What a command changes is told at once.
  void set_delay(Duration delay) noexcept { delay_.set(delay); }
  /// Its axis stays where it is, whatever is commanded.
  void set_sticks(bool on) noexcept { sticks_ = on; }
  void trip() noexcept { fail(Status::error(StatusCode::device_fault, "the mock's drive tripped")); }
  /// A homing under way finds nothing.
  void fail_homing() noexcept { end_homing("the mock's drive found no home"); }
  /// Of the position or velocity in force, within the configuration's limits.
  const std::optional<double>& commanded() const noexcept { return commanded_; }
  std::uint64_t commands() const noexcept { return commands_; }
  std::uint64_t homings() const noexcept { return homings_; }
  std::uint64_t halts() const noexcept { return halts_; }

 private:
  struct Measured {
    double position = 0;
    double velocity = 0;
    Time at{};
  };

  void take_in(const Tick& tick) noexcept override {
    const double elapsed = last_cycle_ == Time{} ? 0 : seconds(tick.now - last_cycle_);
    last_cycle_ = tick.now;
    if (!state_) return;
    if (!may_follow()) end_homing("the homing was interrupted: the drive is not enabled any more");
    const double before = state_->position;
    if (elapsed > 0 && may_follow()) move(elapsed);
    state_->velocity = elapsed > 0 ? (state_->position - before) / elapsed : 0;
    measure();
    tell();
    supervise(configuration, asked_velocity(), profile_target(), tick.now);
  }
  void forget() noexcept override {
    commanded_.reset();
    is_outpaced_ = is_at_its_end_ = false;
    held_ = {};
  }
  void act(const Tick& /*tick*/) noexcept override {
    if (!state_) return;
    state_->enabled = true;
    tell_restraint();
  }
  void rest(const Tick& /*tick*/) noexcept override {
    if (state_) state_->enabled = false;
  }
  bool become_safe() noexcept override {
    forget();
    end_homing("the homing was interrupted: the drive was made safe");
    return true;
  }

  void follow_position(double position) noexcept override {
    if (!takes(ServoMode::cyclic_position, ServoMode::cyclic_position)) return;
    hold({});
    take_position(position);
  }
  void follow_velocity(double velocity) noexcept override {
    if (!takes(ServoMode::cyclic_velocity, ServoMode::profile_velocity) || !is_number(velocity)) return;
    const double kept = std::clamp(velocity, -configuration.fastest, configuration.fastest);
    hold(kept != velocity ? Restraint{servo_restraints::too_fast, velocity, kept} : Restraint{});
    if (commanded_ != kept) state_->target_reached = false;
    take(kept);
  }
  void begin_move(double position, double speed) noexcept override {
    if (!takes(ServoMode::profile_position, ServoMode::profile_position) || !is_number(speed)) return;
    if (!(speed > 0)) {
      fail(Status::error(StatusCode::invalid_argument, "the drive was commanded to move with a speed of %g",
                         speed));
      return;
    }
    speed_ = std::min(speed, configuration.fastest);
    hold(speed_ != speed && speed != full_speed ? Restraint{servo_restraints::too_fast, speed, speed_}
                                                : Restraint{});
    take_position(position);
  }
  void begin_homing() noexcept override {
    if (!may_be_commanded()) return;
    if (configuration.homing_method == 0) return restrain(servo_restraints::no_homing);
    forget();
    homing_ = ServoHoming::running;
    homing_problem_ = {};
    ++homings_;
    tell();
  }

  bool takes_positions() const noexcept {
    return configuration.mode == ServoMode::cyclic_position ||
           configuration.mode == ServoMode::profile_position;
  }
  double asked_velocity() const noexcept {
    return commanded_ && !takes_positions() && !is_at_its_end_ ? *commanded_ : 0;
  }
  std::optional<ProfileTarget> profile_target() const noexcept {
    const bool is_on_its_way = commanded_ && configuration.mode == ServoMode::profile_position &&
                               homing_ != ServoHoming::running && !state_->target_reached;
    if (!is_on_its_way) return std::nullopt;
    return ProfileTarget{.position = *commanded_, .left = *commanded_ - way_, .speed = speed_};
  }
  bool may_follow() const noexcept { return state_ && state_->enabled && may_act(); }
  bool takes(ServoMode one, ServoMode other) noexcept {
    if (!may_be_commanded()) return false;
    if (configuration.mode == one || configuration.mode == other) return true;
    restrain(servo_restraints::another_mode);
    return false;
  }
  bool may_be_commanded() const noexcept { return may_follow() && homing_ != ServoHoming::running; }
  bool is_number(double value) noexcept {
    if (std::isfinite(value)) return true;
    fail(Status::error(StatusCode::invalid_argument, "the drive was commanded to what is not a number"));
    return false;
  }
  void take_position(double position) noexcept {
    if (!is_number(position)) return;
    double kept = std::clamp(position, configuration.lowest, configuration.highest);
    if (configuration.endless) {
      const bool cyclic = configuration.mode == ServoMode::cyclic_position;
      kept = by_the_shorter_way(position, cyclic ? commanded_.value_or(way_) : way_);
    } else if (kept != position) {
      hold({servo_restraints::out_of_range, position, kept});
    }
    take(kept);
    state_->target_reached = false;
  }
  void hold(const Restraint& restraint) noexcept { held_ = restraint; }
  // What was said in this cycle goes before what stands since the command, and that before its consequence.
  void tell_restraint() noexcept {
    if (state_->target_reached && held_.reason == servo_restraints::too_fast && takes_positions()) held_ = {};
    const Restraint said = take_restraint();
    if (is_outpaced_) restrain(servo_restraints::led_too_fast, told(*commanded_), told(set_point_));
    restrain(held_);
    if (is_at_its_end_) restrain(servo_restraints::end_of_range, *commanded_, 0);
    restrain(said);
  }
  void take(double value) noexcept {
    commanded_ = value;
    ++commands_;
  }
  void end_homing(const char* reason) noexcept {
    if (homing_ != ServoHoming::running) return;
    homing_ = ServoHoming::failed;
    homing_problem_ = Status::error(StatusCode::unavailable, "%s", reason);
    tell();
  }

  void move(double elapsed) noexcept {
    const bool cyclic = configuration.mode == ServoMode::cyclic_position;
    is_outpaced_ = is_at_its_end_ = false;
    if (!cyclic || !commanded_) {
      set_point_ = way_;
      follower_.seed(way_);
    }
    if (homing_ == ServoHoming::running) {
      const bool reached = go_to(0, configuration.homing_speed * elapsed);
      if (reached && !sticks_) homing_ = ServoHoming::homed;
      return;
    }
    if (!commanded_) return;
    if (cyclic) {
      follower_.command(*commanded_);
      set_point_ = follower_.next(elapsed);
      is_outpaced_ = std::abs(*commanded_ - set_point_) > configuration.fastest * elapsed;
      state_->target_reached = false;
      if (!sticks_) go_on_to(set_point_);
      return;
    }
    if (takes_positions()) {
      state_->target_reached = go_to(*commanded_, speed_ * elapsed) && !sticks_;
      return;
    }
    if (sticks_) return;
    const double velocity = permitted_velocity(elapsed);
    const double next = way_ + velocity * elapsed;
    go_on_to(configuration.endless ? next : std::clamp(next, configuration.lowest, configuration.highest));
    is_at_its_end_ = velocity != *commanded_;
    state_->target_reached = configuration.mode == ServoMode::profile_velocity && !is_at_its_end_;
  }
  double permitted_velocity(double elapsed) const noexcept {
    if (configuration.endless) return *commanded_;
    const double left = *commanded_ > 0 ? configuration.highest - way_ : way_ - configuration.lowest;
    return slowed_before_end(*commanded_, left, elapsed, configuration.acceleration);
  }
  // True: the set-point is there, and with it the axis.
  bool go_to(double wanted, double most) noexcept {
    const double distance = wanted - set_point_;
    const bool reached = std::abs(distance) <= most;
    set_point_ = reached ? wanted : set_point_ + std::copysign(most, distance);
    if (!sticks_) go_on_to(set_point_);
    return reached;
  }
  void go_on_to(double way) noexcept {
    way_ = way;
    state_->position = told(way);
  }
  double told(double way) const noexcept {
    const double modulo = configuration.endless ? configuration.modulo : 0;
    return modulo > 0 ? way - modulo * std::floor(way / modulo) : way;
  }
  double by_the_shorter_way(double position, double from) const noexcept {
    const double modulo = configuration.modulo;
    return modulo > 0 ? from + std::remainder(position - from, modulo) : position;
  }
  void measure() noexcept {
    if (!state_) return;
    const double noise = noise_.around_zero(configuration.position_noise);
    measured_ = delay_.pass({state_->position + noise, state_->velocity, last_cycle_}, last_cycle_);
  }
  void tell() noexcept {
    if (configuration.homing_method == 0) homing_ = ServoHoming::homed;
    feedback.homing = homing_;
    feedback.enabled = state_ && state_->enabled;
    feedback.target_reached = state_ && state_->target_reached;
    if (!state_) return;
    const bool cyclic = configuration.mode == ServoMode::cyclic_position;
    const double behind = by_the_shorter_way(set_point_ - measured_.position, 0);
    state_->following_error = cyclic && commanded_ ? behind : 0;
    state_->homing = homing_;
    if (homing_ == ServoHoming::running || !commanded_) state_->target_reached = false;
    feedback.position = measured_.position;
    feedback.velocity = measured_.velocity;
    feedback.following_error = state_->following_error;
    feedback.at_internal_limit = state_->at_internal_limit;
  }

  std::optional<ServoState> state_;  // where it is
  Measured measured_;
  std::optional<double> commanded_;
  double way_ = 0;        // its position but for its modulo
  double set_point_ = 0;  // where the axis is to be by now, on its way to what is commanded
  SetPointFollower follower_;
  double speed_ = 1;
  bool sticks_ = false;
  bool is_at_its_end_ = false;
  bool is_outpaced_ = false;  // by more than another cycle makes up for
  Restraint held_;            // of the command that stands
  std::uint64_t commands_ = 0;
  std::uint64_t homings_ = 0;
  std::uint64_t halts_ = 0;
  ServoHoming homing_ = ServoHoming::not_homed;
  Status homing_problem_;
  Time last_cycle_{};
  MockNoise noise_;
  MockDelay<Measured> delay_;
};

}  // namespace flexrf
