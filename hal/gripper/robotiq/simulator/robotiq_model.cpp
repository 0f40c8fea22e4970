#include "hal/gripper/robotiq/simulator/robotiq_model.hpp"

#include <algorithm>
#include <cmath>

namespace flexrf::robotiq {
namespace {

constexpr std::uint8_t turning_current = 20;  // steps

}  // namespace

RobotiqModel::RobotiqModel(const ModelPlan& plan) noexcept
    : plan_(plan), fingers_(plan.closed_width, plan.open_width) {}

double RobotiqModel::opening_of(std::uint8_t count) const noexcept {
  const double counts = plan_.closed_count - plan_.open_count;
  const double share = (count - plan_.open_count) / counts;
  return plan_.open_width + share * (plan_.closed_width - plan_.open_width);
}

std::uint8_t RobotiqModel::count() const noexcept {
  const double share = (fingers_.opening() - plan_.open_width) / (plan_.closed_width - plan_.open_width);
  const double counts = plan_.closed_count - plan_.open_count;
  return static_cast<std::uint8_t>(std::clamp(std::lround(plan_.open_count + share * counts), 0L, 255L));
}

void RobotiqModel::follow(Time now, std::span<std::uint16_t> holding) noexcept {
  constexpr std::size_t end = first_told + 3;
  if (holding.size() < end) return;
  const std::lock_guard lock(mutex_);
  std::uint16_t* const written = &holding[first_written];
  if (forgets_) std::fill_n(written, 3, std::uint16_t{0});
  forgets_ = false;
  disturb();
  if (now_ != Time{} && now > now_) move(std::min<Duration>(now - now_, plan_.longest_step));
  now_ = now;
  take(action_in({written[0], written[1], written[2]}));
  told_.position = count();
  const bool turns =
      told_.is_active() && told_.go && told_.found == Found::moving && told_.fault < first_major_fault;
  told_.current = turns ? turning_current : std::uint8_t{0};
  const Words words = encode(told_);
  std::copy(words.begin(), words.end(), &holding[first_told]);
}

void RobotiqModel::disturb() noexcept {
  if (taken_.exchange(false, std::memory_order_acquire)) fingers_.take_away();
  if (const std::uint8_t fault = fault_.exchange(0, std::memory_order_acquire); fault != 0)
    told_.fault = fault;
  const bool stuck = stuck_.load(std::memory_order_acquire);
  if (stuck == was_stuck_) return;
  was_stuck_ = stuck;
  fingers_.set_stuck(stuck);
}

void RobotiqModel::take(const Action& action) noexcept {
  const Action before = action_;
  action_ = action;
  told_.activate = action.activate;
  told_.go = action.go;
  told_.requested = action.position;
  if (!action.activate) {
    told_.activation = Activation::reset;
    told_.found = Found::moving;
    told_.fault = 0;
    return;
  }
  if (!before.activate) {
    told_.activation = Activation::activating;
    activation_part_ = 0;
  }
  if (told_.activation != Activation::active) {
    if (action.go && told_.fault == 0) told_.fault = 0x05;
    return;
  }
  const bool is_new = action.position != before.position || !before.go;
  if (!action.go || !is_new) return;
  told_.found = Found::moving;
  const double target = opening_of(action.position);
  if (plan_.object_width > 0 && target < fingers_.opening()) fingers_.put_object(plan_.object_width);
}

void RobotiqModel::move(Duration elapsed) noexcept {
  if (!action_.activate || told_.fault >= first_major_fault) return;
  if (told_.activation == Activation::activating) {
    const double target = activation_part_ == 1 ? plan_.closed_width : plan_.open_width;
    if (fingers_.move(target, plan_.activation_speed, elapsed) != FingerModel::Outcome::moves &&
        ++activation_part_ == 3) {
      told_.activation = Activation::active;
      if (told_.fault == 0x05) told_.fault = 0;
    }
    return;
  }
  if (!action_.go) return;
  const double speed = plan_.slowest + action_.speed / 255.0 * (plan_.fastest - plan_.slowest);
  switch (fingers_.move(opening_of(action_.position), speed, elapsed)) {
    case FingerModel::Outcome::arrived:
      told_.found = Found::nothing;
      break;
    case FingerModel::Outcome::stopped_closing:
      told_.found = Found::while_closing;
      break;
    case FingerModel::Outcome::stopped_opening:
      told_.found = Found::while_opening;
      break;
    case FingerModel::Outcome::moves:
      told_.found = Found::moving;
      break;
  }
}

double RobotiqModel::fingers() {
  const std::lock_guard lock(mutex_);
  return fingers_.opening();
}
void RobotiqModel::put_object(double width) {
  const std::lock_guard lock(mutex_);
  fingers_.put_object(width);
}
void RobotiqModel::put_around(double room) {
  const std::lock_guard lock(mutex_);
  fingers_.put_around(room);
}
void RobotiqModel::take_away() {
  const std::lock_guard lock(mutex_);
  fingers_.take_away();
}
void RobotiqModel::set_stuck(bool on) {
  const std::lock_guard lock(mutex_);
  fingers_.set_stuck(on);
}
void RobotiqModel::set_fault(std::uint8_t fault) {
  const std::lock_guard lock(mutex_);
  told_.fault = fault;
}
void RobotiqModel::switch_off_and_on() {
  const std::lock_guard lock(mutex_);
  forgets_ = true;
  action_ = {};
  told_ = {};
}

}  // namespace flexrf::robotiq
