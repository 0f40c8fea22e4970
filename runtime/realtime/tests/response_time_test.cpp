#include "runtime/realtime/response_time.hpp"

#include "tests/cmocka.hpp"

namespace flexrf {
namespace {

using namespace std::chrono_literals;

ResponseTimeTask task(std::uint8_t priority, int execution, int period, int deadline, int jitter = 0,
                      std::uint16_t cpu = 0) {
  ResponseTimeTask made;
  made.name = "task";
  made.cpu = cpu;
  made.priority = priority;
  made.execution = execution * 1ms;
  made.period = period * 1ms;
  made.deadline = deadline * 1ms;
  made.jitter = jitter * 1ms;
  return made;
}

void check(const ResponseTimeResult& result, int expected, bool meets) {
  assert_int_equal(result.response.count(), Duration(expected * 1ms).count());
  assert_int_equal(result.meets_deadline, meets);
}

// Burns and Wellings, Real-Time Systems and Programming Languages, the example of response-time analysis.
void burns_and_wellings_three_tasks(void**) {
  const ResponseTimeTask tasks[] = {task(3, 3, 7, 7), task(2, 3, 12, 12), task(1, 5, 20, 20)};
  ResponseTimeResult results[3];
  assert_true(analyse_response_times(tasks, results));
  check(results[0], 3, true);
  check(results[1], 6, true);
  check(results[2], 20, true);
}

// Ibidem: utilisation 0.82 misses, utilisation 1 with harmonic periods does not.
void utilisation_alone_decides_nothing(void**) {
  const ResponseTimeTask misses[] = {task(1, 12, 50, 50), task(2, 10, 40, 40), task(3, 10, 30, 30)};
  ResponseTimeResult results[3];
  assert_false(analyse_response_times(misses, results));
  check(results[0], 52, false);
  check(results[1], 20, true);
  check(results[2], 10, true);
  const ResponseTimeTask full[] = {task(1, 40, 80, 80), task(2, 10, 40, 40), task(3, 5, 20, 20)};
  assert_true(analyse_response_times(full, results));
  check(results[0], 80, true);
  check(results[1], 15, true);
  check(results[2], 5, true);
}

// Lehoczky, "Fixed priority scheduling of periodic task sets with arbitrary deadlines", 1990: the longest
// response, 118, is that of the fifth release, not of the first (114).
void lehoczky_arbitrary_deadline(void**) {
  const ResponseTimeTask tasks[] = {task(2, 26, 70, 70), task(1, 62, 100, 118)};
  ResponseTimeResult results[2];
  assert_true(analyse_response_times(tasks, results));
  check(results[0], 26, true);
  check(results[1], 118, true);
}

void jitter_lengthens_own_and_lower_responses(void**) {
  // Of the disturbing task, a release delayed by 3 is followed by the next after 7: two fall into a window of
  // 8.
  const ResponseTimeTask tasks[] = {task(2, 3, 10, 10, 3), task(1, 5, 20, 20)};
  ResponseTimeResult results[2];
  assert_true(analyse_response_times(tasks, results));
  check(results[0], 6, true);
  check(results[1], 11, true);
}

void cpus_do_not_disturb_each_other(void**) {
  const ResponseTimeTask tasks[] = {task(2, 6, 10, 10, 0, 0), task(1, 6, 10, 10, 0, 1)};
  ResponseTimeResult results[2];
  assert_true(analyse_response_times(tasks, results));
  check(results[0], 6, true);
  check(results[1], 6, true);
}

void equal_priorities_disturb_each_other(void**) {
  const ResponseTimeTask tasks[] = {task(1, 2, 10, 10), task(1, 3, 10, 10)};
  ResponseTimeResult results[2];
  assert_true(analyse_response_times(tasks, results));
  check(results[0], 5, true);
  check(results[1], 5, true);
}

ResponseTimeTask in_nanoseconds(std::uint8_t priority, std::int64_t execution, std::int64_t period) {
  ResponseTimeTask made = task(priority, 0, 0, 0);
  made.execution = Duration{execution};
  made.period = Duration{period};
  made.deadline = Duration{period};
  return made;
}

// The first runs 99'999 of each 100'000 ns: what the second needs comes together in 1 s, one nanosecond of
// each. Step by step this takes a million rounds.
void close_to_full_is_found_without_going_step_by_step(void**) {
  const ResponseTimeTask tasks[] = {in_nanoseconds(2, 99'999, 100'000),
                                    in_nanoseconds(1, 10'000, 2'000'000'000)};
  ResponseTimeResult results[2];
  assert_true(analyse_response_times(tasks, results));
  assert_true(results[0].response == Duration{99'999});
  check(results[1], 1000, true);
}

// A thousand million rounds to the first completion, and as many releases: neither is waited for.
void as_good_as_full_has_no_bound_that_is_found(void**) {
  const ResponseTimeTask tasks[] = {in_nanoseconds(3, 999'999'999, 1'000'000'000),
                                    in_nanoseconds(2, 100'000'000, 200'000'000'000'000'000),
                                    in_nanoseconds(1, 1, 4'000'000'000)};
  ResponseTimeResult results[3];
  assert_false(analyse_response_times(tasks, results));
  assert_true(results[0].response == Duration{999'999'999});
  assert_true(results[1].response == Duration::max());
  assert_true(results[2].response == Duration::max());
}

void too_much_work_has_no_bound(void**) {
  const ResponseTimeTask tasks[] = {task(2, 6, 10, 10), task(1, 5, 10, 1000)};
  ResponseTimeResult results[2];
  assert_false(analyse_response_times(tasks, results));
  check(results[0], 6, true);
  assert_true(results[1].response == Duration::max());
  assert_false(results[1].meets_deadline);
}

// Periods without a common measure and a load of one: the busy period is as good as endless, the answer comes
// nevertheless.
void nearly_endless_busy_period_ends(void**) {
  ResponseTimeTask first = task(2, 0, 0, 10);
  first.execution = Duration{1'000'000};
  first.period = Duration{2'000'000};
  ResponseTimeTask second = task(1, 0, 0, 10);
  second.execution = Duration{1'000'003};
  second.period = Duration{2'000'003};
  const ResponseTimeTask tasks[] = {first, second};
  ResponseTimeResult results[2];
  analyse_response_times(tasks, results);
  check(results[0], 1, true);
  assert_true(results[1].response > 2ms);
}

void says_that_it_is_an_estimate(void**) {
  const ResponseTimeTask one = task(1, 5, 10, 4);
  char text[200];
  ResponseTimeResult result{5ms, false};
  assert_string_equal(describe_response_time(one, result, text, sizeof(text)),
                      "task: response 5.000 ms, deadline 4.000 ms: missed (estimate from declared budgets, "
                      "kernel and interrupts left out)");
  result.response = Duration::max();
  assert_string_equal(describe_response_time(one, result, text, sizeof(text)),
                      "task: response without bound, deadline 4.000 ms: missed (estimate from declared "
                      "budgets, kernel and interrupts left out)");
}

}  // namespace
}  // namespace flexrf

int main() {
  using namespace flexrf;
  const CMUnitTest tests[] = {
      cmocka_unit_test(burns_and_wellings_three_tasks),
      cmocka_unit_test(utilisation_alone_decides_nothing),
      cmocka_unit_test(lehoczky_arbitrary_deadline),
      cmocka_unit_test(jitter_lengthens_own_and_lower_responses),
      cmocka_unit_test(cpus_do_not_disturb_each_other),
      cmocka_unit_test(equal_priorities_disturb_each_other),
      cmocka_unit_test(close_to_full_is_found_without_going_step_by_step),
      cmocka_unit_test(as_good_as_full_has_no_bound_that_is_found),
      cmocka_unit_test(too_much_work_has_no_bound),
      cmocka_unit_test(nearly_endless_busy_period_ends),
      cmocka_unit_test(says_that_it_is_an_estimate),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
