#include "hal/gripper/pneumatic/pneumatic_gripper.hpp"

#include <algorithm>

#include "base/text.hpp"

namespace flexrf {

Status PneumaticGripper::initialise() {
  stop();
  if (const Status status = check_widths(configuration.closed_width, configuration.open_width); !status)
    return status;
  control_.begin({.open_width = configuration.open_width,
                  .closed_width = configuration.closed_width,
                  .travel_timeout = duration_of(configuration.travel_timeout),
                  .dead_time = duration_of(configuration.dead_time),
                  .closed_centre = configuration.closed_centre,
                  .object_between = configuration.object_between});
  begin(configuration);
  const auto valve = [&](std::string_view line) {
    return DigitalLineSettings{
        .name = line, .direction = LineDirection::output, .active_low = configuration.valves_active_low};
  };
  const auto reed = [&](std::string_view line) {
    return DigitalLineSettings{.name = line,
                               .bias = configuration.reed_bias,
                               .active_low = configuration.reeds_active_low,
                               .debounce = duration_of(configuration.debounce)};
  };
  Status status = reed_open_.open(*bus, reed(text_view(configuration.reed_open)));
  if (status) status = reed_closed_.open(*bus, reed(text_view(configuration.reed_closed)));
  if (status) status = valve_open_.open(*bus, valve(text_view(configuration.valve_open)));
  if (status) status = valve_close_.open(*bus, valve(text_view(configuration.valve_close)));
  if (!status) stop();
  return status;
}

void PneumaticGripper::stop() {
  for (DigitalLine* line : {&valve_open_, &valve_close_, &reed_open_, &reed_closed_}) line->close();
}

std::optional<pneumatic::Reeds> PneumaticGripper::reeds() const noexcept {
  const auto open = reed_open_.state();
  const auto closed = reed_closed_.state();
  if (!open || !closed || !valve_open_.state() || !valve_close_.state()) return std::nullopt;
  return pneumatic::Reeds{open->on, closed->on};
}

void PneumaticGripper::hear(const Tick& tick) noexcept {
  for (DigitalLine* line : {&reed_open_, &reed_closed_, &valve_open_, &valve_close_}) line->receive(tick.now);
  control_.receive(reeds(), tick.now);
}

/// Whether a valve may be on is the control's to say, also while motion is inhibited: to open is safe for
/// some, to stay closed for others.
///
/// The one that is to be off first. A chip that does not take that leaves it on: the other one waits until it
/// is off, and for the dead time from then.
void PneumaticGripper::tell(const Tick& tick, bool /*safe*/) noexcept {
  const pneumatic::End on = control_.valve();
  const Duration dead_time = duration_of(configuration.dead_time);
  const auto set = [&](DigitalLine& valve, bool value) {
    valve.command(value);
    valve.send(tick.now);
  };
  const auto is_vented = [&](const DigitalLine& valve) {
    const auto state = valve.state();
    return state && !state->on && tick.now - Time{Duration{state->since}} >= dead_time;
  };
  if (on != pneumatic::End::open) set(valve_open_, false);
  if (on != pneumatic::End::closed) set(valve_close_, false);
  if (on == pneumatic::End::open && is_vented(valve_close_)) set(valve_open_, true);
  if (on == pneumatic::End::closed && is_vented(valve_open_)) set(valve_close_, true);
}

/// The chip has taken what its valves were told, too.
bool PneumaticGripper::is_at_rest() const noexcept {
  const auto is = [](const DigitalLine& valve, bool on) {
    const auto state = valve.state();
    return state && state->on == on && valve.is_set();
  };
  const pneumatic::End on = control_.wanted_valve();
  return !control_.is_moving() && is(valve_open_, on == pneumatic::End::open) &&
         is(valve_close_, on == pneumatic::End::closed);
}

Time PneumaticGripper::next_event() const noexcept {
  return std::min(reed_open_.next_event(), reed_closed_.next_event());
}

GripperCapabilities PneumaticGripper::capabilities() const noexcept {
  return {.open_width = configuration.open_width,
          .closed_width = configuration.closed_width,
          .detects_object = configuration.object_between,
          .halts = configuration.closed_centre};
}

void PneumaticGripper::go(const GripperGoal& goal) noexcept {
  const bool to_open = goal.opening == configuration.open_width;
  control_.go(to_open ? pneumatic::End::open : pneumatic::End::closed);
}

}  // namespace flexrf
