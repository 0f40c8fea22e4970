// A ring of steps: what is copied out of it, and that a reader beside the writer never sees a mixture.
#include "runtime/executive/step_trace.hpp"

#include <thread>
#include <vector>

#include "tests/cmocka.hpp"

namespace flexrf::step_trace_test {
namespace {

Time at(std::int64_t ns) {
  return Time{Duration{ns}};
}

/// Step n is of unit n modulo 7, begins at 100 n and takes n.
TracedStep step(std::int64_t number) {
  return {static_cast<std::uint16_t>(number % 7), at(100 * number), Duration{number}};
}

bool is_step(const TracedStep& traced) {
  const std::int64_t number = traced.took.count();
  return traced.begin == at(100 * number) && traced.unit == number % 7;
}

void the_newest_are_copied_the_oldest_first(void**) {
  const auto trace = std::make_unique<StepTrace>();
  std::vector<TracedStep> copied(StepTrace::most);
  assert_int_equal(trace->copy(Time{}, copied).count, 0);
  for (std::int64_t i = 1; i <= 10; ++i) trace->note(step(i));
  StepTrace::Copied all = trace->copy(Time{}, copied);
  assert_int_equal(all.count, 10);
  assert_false(all.cut);
  for (std::size_t i = 0; i < 10; ++i)
    assert_true(is_step(copied[i]) && copied[i].took.count() == static_cast<std::int64_t>(i) + 1);
  // Those that ended by then are of no interest.
  all = trace->copy(at(707), copied);
  assert_int_equal(all.count, 3);
  assert_false(all.cut);
  assert_int_equal(copied[0].took.count(), 8);
  all = trace->copy(Time{}, std::span{copied}.first(4));
  assert_int_equal(all.count, 4);
  assert_true(all.cut);
  assert_int_equal(copied[3].took.count(), 10);
}

void what_was_overwritten_is_gone(void**) {
  const auto trace = std::make_unique<StepTrace>();
  std::vector<TracedStep> copied(2 * StepTrace::entries);
  constexpr std::int64_t many = 3 * static_cast<std::int64_t>(StepTrace::entries);
  for (std::int64_t i = 1; i <= many; ++i) trace->note(step(i));
  const StepTrace::Copied all = trace->copy(Time{}, copied);
  assert_int_equal(all.count, StepTrace::most);
  assert_true(all.cut);
  assert_int_equal(copied[all.count - 1].took.count(), many);
  for (std::size_t i = 0; i < all.count; ++i) assert_true(is_step(copied[i]));
  // All that ended since then are there.
  assert_false(trace->copy(at(100 * many - 1000), copied).cut);
}

void a_step_that_took_days_is_told_as_the_longest(void**) {
  const auto trace = std::make_unique<StepTrace>();
  TracedStep copied[1];
  trace->note({65535, at(7), Duration::max()});
  assert_int_equal(trace->copy(Time{}, copied).count, 1);
  assert_true(copied[0].unit == 65535 && copied[0].begin == at(7));
  assert_int_equal(copied[0].took.count(), (std::int64_t{1} << 47) - 1);
}

void steps_are_noted_while_somebody_asks(void**) {
  StepTraces traces(2);
  assert_null(traces.asked(1, at(5)));
  traces.ask(at(10));
  assert_ptr_equal(traces.asked(1, at(9)), &traces.of(1));
  assert_ptr_not_equal(traces.asked(0, at(9)), traces.asked(1, at(9)));
  assert_null(traces.asked(1, at(10)));
}

void a_reader_beside_the_writer_sees_whole_steps(void**) {
  const auto trace = std::make_unique<StepTrace>();
  std::atomic<bool> ends{false};
  std::thread writer([&] {
    for (std::int64_t i = 1; !ends; ++i) trace->note(step(i));
  });
  std::vector<TracedStep> copied(StepTrace::most);
  std::size_t seen = 0;
  bool whole = true;
  // The writer goes around several times.
  for (std::int64_t newest = 0; newest < 20 * static_cast<std::int64_t>(StepTrace::entries) && whole;) {
    const StepTrace::Copied all = trace->copy(Time{}, copied);
    for (std::size_t i = 0; i < all.count; ++i) {
      whole =
          whole && is_step(copied[i]) && (i == 0 || copied[i].took.count() == copied[i - 1].took.count() + 1);
    }
    if (all.count > 0) newest = copied[all.count - 1].took.count();
    seen += all.count;
  }
  ends = true;
  writer.join();
  assert_true(whole);
  assert_true(seen > 0);
}

}  // namespace
}  // namespace flexrf::step_trace_test

int main() {
  using namespace flexrf::step_trace_test;
  const CMUnitTest tests[] = {
      cmocka_unit_test(the_newest_are_copied_the_oldest_first),
      cmocka_unit_test(what_was_overwritten_is_gone),
      cmocka_unit_test(a_step_that_took_days_is_told_as_the_longest),
      cmocka_unit_test(steps_are_noted_while_somebody_asks),
      cmocka_unit_test(a_reader_beside_the_writer_sees_whole_steps),
  };
  return cmocka_run_group_tests_name("step trace", tests, nullptr, nullptr);
}
