// MxtArm: a driver of RobotArm over a generated base, for a MELFA controller in real-time external control.
// What differs between drivers is the link to the controller.
#pragma once

#include "hal/driver/trouble_log.hpp"
#include "hal/robot_arm/interface/robot_arm.hpp"
#include "hal/robot_arm/melfa_mxt/mxt_dialogue.hpp"
#include "motion/kinematics.hpp"

namespace flexrf::melfa {

/// `where`: the controller, for a person.
Status lost_controller(const char* where, double silence_limit, const PacingCounters& counters) noexcept;
/// `unknown_joint`: see MxtDialogue::unknown_joint().
Status not_heard_yet(const char* where, std::size_t unknown_joint) noexcept;

template <class Base>
class MxtArm : public Base {
 public:
  Status initialise() override {
    const auto& set = this->configuration;
    DialoguePlan plan;
    plan.cycle = set.cycle;
    plan.pacing.answer = duration_of(set.answer_timeout);
    plan.pacing.silence = duration_of(set.silence_limit);
    plan.pacing.search = duration_of(set.search_interval);
    // Counts on from session to session, faster than packets do: what was said in one before has another
    // number.
    constexpr std::int64_t a_number = 1'000'000;  // ns
    if (!this->environment().virtual_time)
      plan.pacing.first_number = static_cast<std::uint32_t>(nanoseconds(MonotonicClock::now()) / a_number);
    ended_ = was_heard_ = false;
    state_.reset();
    this->begin_supervision(this->configuration);
    if (const Status status = open_link(); !status) return status;
    const Status status = dialogue_.begin(plan, *this->chain, link());
    if (!status) close_link();
    return status;
  }
  void stop() override {
    dialogue_.close();
    close_link();
  }

  std::optional<JointState> state() const noexcept override { return state_; }
  Time measured_at() const noexcept override { return dialogue_.told_at(); }

  const PacingCounters& counters() const noexcept { return dialogue_.counters(); }

 protected:
  virtual Status open_link() = 0;
  virtual void close_link() noexcept = 0;
  virtual DatagramLink& link() noexcept = 0;
  /// The controller's name for a person.
  virtual const char* where() const noexcept = 0;

 private:
  void take_in(const Tick& tick) noexcept override {
    dialogue_.receive(tick.now);
    if (dialogue_.has_lost_it() && this->fault().is_ok())
      this->fail(lost_controller(where(), this->configuration.silence_limit, dialogue_.counters()));
    if (!was_heard_) tell_whether_it_is_there(tick.now);
    tell_state();
    this->supervise(tick.now);
  }
  // A dialogue that may not lead forgets by itself what it was commanded.
  void forget() noexcept override {}
  void act(const Tick& tick) noexcept override { exchange(tick, true); }
  void rest(const Tick& tick) noexcept override {
    if (ended_ && this->is_inhibited()) {
      ended_ = false;
      dialogue_.reopen();  // to see where the arm is
    }
    exchange(tick, false);
  }
  void exchange(const Tick& tick, bool may_lead) noexcept {
    dialogue_.send(may_lead, tick.now);
    if (dialogue_.is_leading()) this->restrain(dialogue_.restraint());
  }
  bool become_safe() noexcept override {
    dialogue_.end();
    ended_ = dialogue_.has_ended();
    return ended_;
  }
  bool is_operational() const noexcept override { return dialogue_.is_leading(); }
  void follow(const JointPositions& set_points) noexcept override {
    this->tell_limits(set_points);
    dialogue_.command(set_points.position);
  }

  /// Until it was heard; that it fell silent later is a fault if it was led, and else the unit says it.
  void tell_whether_it_is_there(Time now) noexcept {
    was_heard_ = dialogue_.told().has_value();
    log_.look(this->name(), was_heard_ ? Status{} : not_heard_yet(where(), dialogue_.unknown_joint()), now);
  }
  void tell_state() noexcept {
    this->feedback.late = dialogue_.counters().late;
    this->feedback.lost = dialogue_.counters().lost;
    this->feedback.foreign = dialogue_.counters().foreign;
    state_.reset();
    const auto& told = dialogue_.told();
    if (!told) return;
    state_.emplace();
    state_->position = told->measured;
    state_->velocity = told->velocity;
    this->feedback.position = told->measured;
    for (std::size_t i = 0; i < max_joints; ++i) {
      this->feedback.following_error[i] = told->commanded[i] - told->measured[i];
    }
  }

  MxtDialogue dialogue_;
  std::optional<JointState> state_;
  TroubleLog log_;
  bool was_heard_ = false;
  bool ended_ = false;  // the dialogue, so that the arm is safe; until its end was seen
};

}  // namespace flexrf::melfa
