#include "hal/gpio/lines/conformance/digital_io_conformance.hpp"

#include "tests/conformance.hpp"
#include "tests/recovery.hpp"

namespace flexrf {
namespace {

constexpr Duration cycle = std::chrono::milliseconds(1);
/// Cycles after which what must happen has happened. Only the real kernel takes more than one.
constexpr int patience = 10000;
/// Longer than any machine stalls, so that what is shorter is shorter.
constexpr Duration long_debounce = std::chrono::seconds(20);

MakeDigitalIoWorld make_world = nullptr;

void one_cycle(DigitalIoWorld& world) {
  world.receive(cycle);
  world.send();
}

template <class Condition>
bool until(DigitalIoWorld& world, Condition is_true) {
  for (int i = 0; i < patience; ++i) {
    world.receive(cycle);
    const bool done = is_true();
    world.send();
    if (done) return true;
  }
  return false;
}

bool becomes(DigitalIoWorld& world, bool on) {
  return until(world, [&] {
    const auto state = world.io().state();
    return state && state->on == on;
  });
}

/// The cause is gone as of the last cycle; nobody drives or commands the line.
bool is_back(DigitalIoWorld& world, const char* from) {
  const Time since = world.now();
  return becomes(world, false) && is_back_in_time(from, world.now() - since);
}

std::optional<DigitalEdge> wait_for_edge(DigitalIoWorld& world) {
  std::optional<DigitalEdge> edge;
  until(world, [&] {
    edge = world.io().read_edge();
    return edge.has_value();
  });
  return edge;
}

/// An input that nobody drives, and the first cycle of its clock.
bool starts(DigitalIoWorld& world) {
  world.drive(false);
  if (!world.start({})) return false;
  one_cycle(world);
  return true;
}

DigitalLineSettings output() {
  return {.direction = LineDirection::output};
}

// [digital-io-1]
Verdict an_input_is_what_the_far_end_drives(DigitalIoWorld& world) {
  world.drive(true);
  if (!world.start({}) || !becomes(world, true)) return Verdict::failed;
  world.drive(false);
  if (!becomes(world, false)) return Verdict::failed;
  world.drive(true);
  return verdict(becomes(world, true));
}

// [gpio-chip-1]
Verdict active_low_turns_it_round(DigitalIoWorld& world) {
  world.drive(true);
  if (!world.start({.active_low = true}) || !becomes(world, false)) return Verdict::failed;
  world.drive(false);
  const auto edge = wait_for_edge(world);
  return verdict(edge && edge->on && becomes(world, true));
}

// [digital-io-2] [gpio-chip-3]
Verdict each_change_is_an_edge_with_its_time(DigitalIoWorld& world) {
  world.drive(false);
  if (!world.start({})) return Verdict::failed;
  one_cycle(world);
  for (const bool high : {true, false, true}) {
    const Time before = world.now();
    world.drive(high);
    const auto edge = wait_for_edge(world);
    one_cycle(world);
    if (!edge || edge->on != high || edge->at < nanoseconds(before) || edge->at > nanoseconds(world.now()))
      return Verdict::failed;
  }
  return verdict(!world.io().read_edge());
}

// [digital-io-1] [digital-io-2]
Verdict a_level_shorter_than_debounce_is_an_edge_and_no_state(DigitalIoWorld& world) {
  world.drive(false);
  if (!world.start({.debounce = long_debounce})) return Verdict::failed;
  one_cycle(world);
  for (const bool high : {true, false}) {
    world.drive(high);
    const auto edge = wait_for_edge(world);
    const auto state = world.io().state();
    if (!edge || edge->on != high || !state || state->on) return Verdict::failed;
  }
  return Verdict::passed;
}

Verdict a_level_longer_than_debounce_is_a_state_since_its_edge(DigitalIoWorld& world) {
  constexpr Duration debounce = std::chrono::milliseconds(20);
  world.drive(false);
  if (!world.start({.debounce = debounce})) return Verdict::failed;
  one_cycle(world);
  const Time before = world.now();
  world.drive(true);
  if (!becomes(world, true)) return Verdict::failed;
  const auto state = world.io().state();
  return verdict(state && state->since >= nanoseconds(before) &&
                 state->since <= nanoseconds(world.now() - debounce));
}

// [digital-io-1] [digital-io-3]
Verdict an_output_begins_safe_and_follows_its_commands(DigitalIoWorld& world) {
  if (!world.start(output())) return Verdict::failed;
  one_cycle(world);
  if (world.sees_high() || !becomes(world, false)) return Verdict::failed;
  world.receive(cycle);
  world.io().command(true);
  world.send();
  one_cycle(world);  // held without a further command
  return verdict(world.sees_high() && becomes(world, true));
}

// [gpio-chip-1]
Verdict an_active_low_output_is_safe_at_its_safe_value(DigitalIoWorld& world) {
  if (!world.start({.direction = LineDirection::output, .active_low = true, .safe_value = true}))
    return Verdict::failed;
  one_cycle(world);
  if (world.sees_high() || !becomes(world, true)) return Verdict::failed;
  world.receive(cycle);
  world.io().command(false);
  world.send();
  return verdict(world.sees_high());
}

// [digital-io-4]
Verdict an_inhibited_output_holds_and_forgets(DigitalIoWorld& world) {
  if (!world.start(output())) return Verdict::failed;
  one_cycle(world);
  world.io().set_inhibited(true);
  world.receive(cycle);
  world.io().command(true);
  world.send();
  if (world.sees_high()) return Verdict::failed;
  world.io().set_inhibited(false);
  one_cycle(world);
  return verdict(!world.sees_high());
}

// [digital-io-4]
Verdict a_signal_is_not_inhibited(DigitalIoWorld& world) {
  if (!world.start(output(), true)) return Verdict::failed;
  one_cycle(world);
  world.io().set_inhibited(true);
  world.receive(cycle);
  world.io().command(true);
  world.send();
  return verdict(world.sees_high());
}

// [digital-io-5]
Verdict an_output_can_be_made_safe(DigitalIoWorld& world) {
  if (!world.start(output())) return Verdict::failed;
  one_cycle(world);
  world.receive(cycle);
  world.io().command(true);
  world.send();
  if (!world.sees_high()) return Verdict::failed;
  world.receive(cycle);
  world.io().command(true);  // of this very cycle
  world.io().set_inhibited(true);
  static_cast<void>(world.io().make_safe());
  world.send();
  return verdict(!world.sees_high() && until(world, [&] { return world.io().make_safe(); }) &&
                 !world.sees_high());
}

// [digital-line-1] [digital-line-2]
Verdict an_emergency_stop_permits_only_while_it_is_on(DigitalIoWorld& world) {
  world.drive(true);
  if (!world.start({.emergency_stop = true}) || !world.io().guards_motion()) return Verdict::failed;
  if (!world.io().demands_safe_state()) return Verdict::failed;  // nothing is known yet
  if (!until(world, [&] { return !world.io().demands_safe_state(); })) return Verdict::failed;
  world.drive(false);
  if (!until(world, [&] { return world.io().demands_safe_state(); })) return Verdict::failed;
  world.drive(true);
  return verdict(until(world, [&] { return !world.io().demands_safe_state(); }));
}

// [digital-line-2] [gpio-chip-3]
Verdict an_emergency_stop_shorter_than_a_cycle_counts(DigitalIoWorld& world) {
  world.drive(true);
  if (!world.start({.emergency_stop = true})) return Verdict::failed;
  if (!until(world, [&] { return !world.io().demands_safe_state(); })) return Verdict::failed;
  world.drive(false);
  world.drive(true);
  if (!until(world, [&] { return world.io().demands_safe_state(); })) return Verdict::failed;
  return verdict(until(world, [&] { return !world.io().demands_safe_state(); }));
}

// [digital-line-3]
Verdict a_released_emergency_stop_is_debounced(DigitalIoWorld& world) {
  world.drive(false);
  if (!world.start({.debounce = long_debounce, .emergency_stop = true})) return Verdict::failed;
  one_cycle(world);
  world.drive(true);
  return verdict(wait_for_edge(world) && world.io().demands_safe_state());
}

// [digital-line-4]
Verdict an_output_is_no_emergency_stop(DigitalIoWorld& world) {
  const Status status = world.start({.direction = LineDirection::output, .emergency_stop = true});
  return verdict(status.code() == StatusCode::invalid_argument && status.cause()[0] != '\0');
}

// [gpio-chip-5]
Verdict a_line_in_use_is_refused_with_its_cause(DigitalIoWorld& world) {
  if (!world.occupy()) return Verdict::skipped;
  const Status status = world.start({});
  if (status.code() != StatusCode::busy || status.cause()[0] == '\0') return Verdict::failed;
  world.let_go();
  return verdict(starts(world) && is_back(world, "another user of the line"));
}

// [gpio-chip-5]
Verdict a_chip_that_is_missing_at_the_start_is_told(DigitalIoWorld& world) {
  if (!world.unplug()) return Verdict::skipped;
  const Status status = world.start({});
  if (status.code() != StatusCode::unavailable || status.cause()[0] == '\0') return Verdict::failed;
  return verdict(world.plug_in() && starts(world) && is_back(world, "a chip that was missing"));
}

// [gpio-chip-5]
Verdict a_missing_right_is_told(DigitalIoWorld& world) {
  if (!world.forbid()) return Verdict::skipped;
  const Status status = world.start({});
  if (status.code() != StatusCode::not_permitted || status.cause()[0] == '\0') return Verdict::failed;
  world.permit();
  return verdict(starts(world) && is_back(world, "a missing right"));
}

// [digital-io-1] [digital-line-1] [gpio-chip-2]
Verdict an_input_survives_its_chip(DigitalIoWorld& world) {
  world.drive(true);
  if (!world.start({.emergency_stop = true})) return Verdict::failed;
  if (!until(world, [&] { return !world.io().demands_safe_state(); })) return Verdict::failed;
  if (!world.unplug()) return Verdict::skipped;
  if (!until(world, [&] { return !world.io().state(); }) || !world.io().demands_safe_state())
    return Verdict::failed;
  if (!world.plug_in() || !is_back(world, "an input's chip that was gone") ||
      !world.io().demands_safe_state())
    return Verdict::failed;
  world.drive(true);
  return verdict(becomes(world, true) && until(world, [&] { return !world.io().demands_safe_state(); }) &&
                 world.io().fault().is_ok());
}

// [digital-io-7] [digital-io-9] [gpio-chip-2] [gpio-chip-4]
Verdict an_output_comes_back_safe(DigitalIoWorld& world) {
  if (!world.start(output())) return Verdict::failed;
  one_cycle(world);
  world.receive(cycle);
  world.io().command(true);
  world.send();
  if (!world.sees_high()) return Verdict::failed;
  if (!world.unplug()) return Verdict::skipped;
  if (!until(world, [&] { return !world.io().state(); })) return Verdict::failed;
  world.receive(cycle);
  world.io().command(true);  // to nobody
  world.send();
  world.io().set_inhibited(true);
  // While the chip is away its output is unknown, so safety is not confirmed.
  if (world.io().make_safe()) return Verdict::failed;
  if (!world.plug_in() || !is_back(world, "an output's chip that was gone") || world.sees_high())
    return Verdict::failed;
  if (!until(world, [&] { return world.io().make_safe(); })) return Verdict::failed;
  one_cycle(world);
  world.io().set_inhibited(false);
  world.receive(cycle);
  world.io().command(true);
  world.send();
  return verdict(world.sees_high());
}

template <Verdict (*Run)(DigitalIoWorld&)>
void judged(void**) {
  judge(make_world, Run);
}

}  // namespace

int run_digital_io_conformance(const char* driver, MakeDigitalIoWorld make) {
  make_world = make;
#define CASE(name) \
  { #name, judged < name>, nullptr, nullptr, nullptr }
  const CMUnitTest tests[] = {
      CASE(an_input_is_what_the_far_end_drives),
      CASE(active_low_turns_it_round),
      CASE(each_change_is_an_edge_with_its_time),
      CASE(a_level_shorter_than_debounce_is_an_edge_and_no_state),
      CASE(a_level_longer_than_debounce_is_a_state_since_its_edge),
      CASE(an_output_begins_safe_and_follows_its_commands),
      CASE(an_active_low_output_is_safe_at_its_safe_value),
      CASE(an_inhibited_output_holds_and_forgets),
      CASE(a_signal_is_not_inhibited),
      CASE(an_output_can_be_made_safe),
      CASE(an_emergency_stop_permits_only_while_it_is_on),
      CASE(an_emergency_stop_shorter_than_a_cycle_counts),
      CASE(a_released_emergency_stop_is_debounced),
      CASE(an_output_is_no_emergency_stop),
      CASE(a_line_in_use_is_refused_with_its_cause),
      CASE(a_chip_that_is_missing_at_the_start_is_told),
      CASE(a_missing_right_is_told),
      CASE(an_input_survives_its_chip),
      CASE(an_output_comes_back_safe),
  };
#undef CASE
  return cmocka_run_group_tests_name(driver, tests, nullptr, nullptr);
}

}  // namespace flexrf
