#include "hal/watchdog/conformance/watchdog_conformance.hpp"

#include "base/text.hpp"
#include "tests/conformance.hpp"

namespace flexrf {
namespace {

constexpr Duration moment = std::chrono::milliseconds{100};

MakeWatchdogWorld make_world = nullptr;

// Each case runs in here, so that a failing assertion jumps over no destructor.
template <Verdict (*Run)(WatchdogWorld&)>
void judged(void**) {
  Verdict result = Verdict::failed;
  {
    const std::unique_ptr<WatchdogWorld> world = make_world();
    result = Run(*world);
    // Whatever the case left it at: the timer is not to outlive it.
    if (world->counts() && world->start({})) world->watchdog().stop();
  }
  conclude(result);
}

/// Cycles as often as a thread that is released by the driver's own word has them.
void live(WatchdogWorld& world, Duration time, const char* missed_by = nullptr) {
  for (Duration passed{}; passed < time; passed += moment) world.cycle(moment, missed_by);
}

bool is_refused(const Status& status, StatusCode code) {
  return status.code() == code && status.cause()[0] != '\0';
}

// [watchdog-3]
Verdict it_is_armed_from_the_start_with_the_time_out_it_is_given(WatchdogWorld& world) {
  if (world.counts() || world.feedback().armed || !world.start({.timeout = 20})) return Verdict::failed;
  return verdict(world.counts() && world.feedback().armed && world.feedback().timeout == 20);
}

// [watchdog-1]
Verdict it_is_fed_at_once_and_four_times_within_its_time_out(WatchdogWorld& world) {
  if (!world.start({.timeout = 8})) return Verdict::failed;
  world.cycle(moment, nullptr);
  if (world.feedback().fed != 1) return Verdict::failed;
  live(world, std::chrono::seconds{80});
  return verdict(world.feedback().fed == 41 && world.feedback().withheld == 0 && world.counts() &&
                 world.feedback().least_left > 5.8 && world.watchdog().fault().is_ok());
}

Verdict its_thread_is_released_when_it_is_to_be_fed(WatchdogWorld& world) {
  if (!world.start({.timeout = 8})) return Verdict::failed;
  world.cycle(moment, nullptr);
  const Time next = world.watchdog().next_event();
  world.cycle(std::chrono::milliseconds{1999}, nullptr);
  if (world.feedback().fed != 1 || world.watchdog().next_event() != next) return Verdict::failed;
  world.cycle(std::chrono::milliseconds{1}, nullptr);
  return verdict(world.feedback().fed == 2 &&
                 world.watchdog().next_event() == next + std::chrono::seconds{2});
}

// [watchdog-1] [watchdog-2]
Verdict it_is_not_fed_while_a_thread_is_silent(WatchdogWorld& world) {
  if (!world.start({.timeout = 20})) return Verdict::failed;
  live(world, std::chrono::seconds{10});
  const std::uint64_t fed = world.feedback().fed;
  live(world, std::chrono::seconds{10}, "control");
  return verdict(world.feedback().fed == fed && world.feedback().withheld > 0 &&
                 text_view(world.feedback().missed_by) == "control");
}

// [watchdog-1] [watchdog-2]
Verdict it_is_fed_again_when_the_thread_is_back(WatchdogWorld& world) {
  if (!world.start({.timeout = 20})) return Verdict::failed;
  live(world, std::chrono::seconds{10});
  live(world, std::chrono::seconds{8}, "control");
  const std::uint64_t fed = world.feedback().fed;
  // A quarter of what lies between two feedings.
  live(world, std::chrono::milliseconds{1250});
  return verdict(world.feedback().fed == fed + 1 && world.feedback().least_left < 12);
}

Verdict the_shortest_time_out_is_fed_twice_a_second(WatchdogWorld& world) {
  if (!world.start({.timeout = 2})) return Verdict::failed;
  live(world, std::chrono::seconds{10});
  return verdict(world.feedback().fed == 20);
}

// [watchdog-4]
Verdict an_orderly_end_disarms_it(WatchdogWorld& world) {
  if (!world.start({})) return Verdict::failed;
  live(world, std::chrono::seconds{1});
  world.watchdog().stop();
  return verdict(!world.counts() && !world.feedback().armed);
}

// [watchdog-4]
Verdict it_is_left_armed_if_it_is_to_be(WatchdogWorld& world) {
  if (!world.start({.timeout = 30, .leave_armed = true})) return Verdict::failed;
  live(world, std::chrono::seconds{1});
  world.watchdog().stop();
  return verdict(world.counts() && world.feedback().armed);
}

Verdict who_starts_next_takes_over_what_was_left_armed(WatchdogWorld& world) {
  if (!world.start({.timeout = 30, .leave_armed = true})) return Verdict::failed;
  world.watchdog().stop();
  if (!world.start({.timeout = 20})) return Verdict::failed;
  live(world, std::chrono::seconds{20});
  if (world.feedback().fed == 0 || world.feedback().timeout != 20) return Verdict::failed;
  world.watchdog().stop();
  return verdict(!world.counts());
}

Verdict a_time_out_that_is_too_long_for_it_is_refused(WatchdogWorld& world) {
  const auto longest = world.longest();
  if (!longest) return Verdict::skipped;
  return verdict(is_refused(world.start({.timeout = *longest + 1}), StatusCode::out_of_range) &&
                 !world.counts() && !world.feedback().armed);
}

Verdict a_warning_as_early_as_the_time_out_is_refused(WatchdogWorld& world) {
  return verdict(is_refused(world.start({.timeout = 10, .pretimeout = 10}), StatusCode::invalid_argument) &&
                 !world.counts());
}

Verdict a_warning_is_given_or_said_not_to_be(WatchdogWorld& world) {
  if (!world.start({.timeout = 20, .pretimeout = 5})) return Verdict::failed;
  return verdict(world.feedback().pretimeout == 5 || world.feedback().pretimeout == 0);
}

Verdict who_has_it_already_is_told(WatchdogWorld& world) {
  if (!world.occupy()) return Verdict::skipped;
  return verdict(is_refused(world.start({}), StatusCode::busy));
}

Verdict a_missing_right_is_told(WatchdogWorld& world) {
  if (!world.forbid()) return Verdict::skipped;
  return verdict(is_refused(world.start({}), StatusCode::not_permitted));
}

Verdict that_there_is_none_is_told(WatchdogWorld& world) {
  if (!world.take_away()) return Verdict::skipped;
  return verdict(is_refused(world.start({}), StatusCode::unavailable));
}

}  // namespace

int run_watchdog_conformance(const char* driver, MakeWatchdogWorld make) {
  make_world = make;
#define CASE(name) \
  { #name, judged < name>, nullptr, nullptr, nullptr }
  const CMUnitTest tests[] = {
      CASE(it_is_armed_from_the_start_with_the_time_out_it_is_given),
      CASE(it_is_fed_at_once_and_four_times_within_its_time_out),
      CASE(its_thread_is_released_when_it_is_to_be_fed),
      CASE(it_is_not_fed_while_a_thread_is_silent),
      CASE(it_is_fed_again_when_the_thread_is_back),
      CASE(the_shortest_time_out_is_fed_twice_a_second),
      CASE(an_orderly_end_disarms_it),
      CASE(it_is_left_armed_if_it_is_to_be),
      CASE(who_starts_next_takes_over_what_was_left_armed),
      CASE(a_time_out_that_is_too_long_for_it_is_refused),
      CASE(a_warning_as_early_as_the_time_out_is_refused),
      CASE(a_warning_is_given_or_said_not_to_be),
      CASE(who_has_it_already_is_told),
      CASE(a_missing_right_is_told),
      CASE(that_there_is_none_is_told),
  };
#undef CASE
  return cmocka_run_group_tests_name(driver, tests, nullptr, nullptr);
}

}  // namespace flexrf
