#include "units/signal_tower/signal_tower.hpp"

namespace flexrf::user {

void SignalTower::step(const Tick& tick) {
  const auto input = emergency_stop->state();
  StopButton told{};
  told.known = input.has_value();
  told.released = input && input->on;
  button.publish(told);
  feedback.released = told.released;

  TowerSignal shown{};
  if (const auto wanted = signal.latest()) {
    shown = *wanted;
  } else {
    shown.red = LampMode::blink;
  }
  feedback.green = is_lit(shown.green, tick.now);
  feedback.yellow = is_lit(shown.yellow, tick.now);
  feedback.red = is_lit(shown.red, tick.now);
  green->command(feedback.green);
  yellow->command(feedback.yellow);
  red->command(feedback.red);
}

bool SignalTower::is_lit(LampMode mode, Time now) const noexcept {
  if (mode != LampMode::blink) return mode == LampMode::on;
  const auto half = static_cast<Duration::rep>(configuration.blink_period * 0.5e9);
  return nanoseconds(now) / half % 2 == 0;
}

}  // namespace flexrf::user
