// What a look at a queue's scores tells, and that it leaves the queue as it is.
#include <cmath>
#include <limits>

#include "runtime/blackboard/job_queue.hpp"
#include "runtime/blackboard/queue_ring.hpp"
#include "runtime/blackboard/test_types.hpp"
#include "tests/cmocka.hpp"

namespace flexrf::job_scores_test {
namespace {

using test::Sample;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr JobOrder by_value{true, Scalar::f64, offsetof(Sample, value)};
constexpr JobOrder by_number{true, Scalar::u32, offsetof(Sample, number)};

template <std::size_t Cells>
struct Jobs {
  explicit Jobs(JobOrder order) : queue(&test::sample_type, memory.view(), DropPolicy::drop_newest, order) {}
  void push(std::uint32_t number, double score) { push(one, number, score); }
  static void push(JobSink& sink, std::uint32_t number, double score) {
    const Sample value{number, score, 0};
    assert_true(sink.push(&value, Time{}));
  }
  JobQueueMemory<Sample, Cells> memory{};
  JobQueue queue;
  JobSink one{&queue};
  JobSink two{&queue};
};

// [board-46]
void the_highest_come_first_and_nothing_is_taken(void**) {
  Jobs<6> jobs{by_value};
  double told[8] = {};
  assert_true(jobs.queue.is_by_score());
  assert_int_equal(jobs.queue.scores(told), 0);
  for (const double score : {-1.0, 3.0, 0.0, 0.875, -1e300, 3.0}) jobs.push(1, score);
  assert_int_equal(jobs.queue.scores(told), 6);
  const double ordered[] = {3, 3, 0.875, 0, -1};
  for (std::size_t i = 0; i < std::size(ordered); ++i) assert_true(told[i] == ordered[i]);
  assert_true(std::abs(told[5] / -1e300 - 1) < 1e-14);  // the last two bits do not count
  assert_int_equal(jobs.queue.fill(), 6);
  assert_int_equal(jobs.one.counters().popped, 0);
  Sample best{};
  ItemHeader header{};
  assert_true(jobs.queue.pop(&best, header) && best.value == 3);
  assert_int_equal(jobs.queue.scores(told), 5);
  assert_true(told[0] == 3 && told[1] == 0.875);
}

// [board-46]
void as_many_are_told_as_there_is_room_for(void**) {
  Jobs<40> jobs{by_value};
  for (std::uint32_t i = 0; i < 40; ++i) jobs.push(i, (i * 7) % 40);
  double told[6] = {0, 0, 0, 0, 0, 17};
  assert_int_equal(jobs.queue.scores(std::span{told}.first(5)), 5);
  for (int i = 0; i < 5; ++i) assert_true(told[i] == 39 - i);
  assert_true(told[5] == 17);
  assert_int_equal(jobs.queue.scores({}), 0);
}

// [board-46]
void scores_of_all_kinds_are_told(void**) {
  double told[4] = {};
  Jobs<4> odd{by_value};
  odd.two.set_deferred(true);
  odd.push(1, std::numeric_limits<double>::quiet_NaN());
  odd.push(2, -infinity);
  odd.push(3, infinity);
  Jobs<4>::push(odd.two, 4, 5);  // not visible yet
  assert_int_equal(odd.queue.scores(told), 3);
  assert_true(told[0] == infinity && told[1] == -infinity && std::isnan(told[2]));
  odd.two.commit();
  assert_int_equal(odd.queue.scores(told), 4);
  assert_true(told[1] == 5);

  Jobs<2> whole{by_number};
  whole.push(7, 0);
  whole.push(4'000'000'000, 0);
  assert_int_equal(whole.queue.scores(told), 2);
  assert_true(told[0] == 4e9 && told[1] == 7);
}

// [board-46]
void without_a_score_none_are_told(void**) {
  double told[4] = {};
  Jobs<2> unordered{JobOrder{}};
  unordered.push(1, 5);
  QueueRingMemory<Sample, 2> memory{};
  QueueRing ring(&test::sample_type, memory.view(), DropPolicy::drop_newest);
  const Sample value{1, 5, 0};
  assert_true(ring.push(&value, Time{}));
  for (const QueueSource* source :
       {static_cast<const QueueSource*>(&unordered.queue), static_cast<const QueueSource*>(&ring)}) {
    assert_false(source->is_by_score());
    assert_int_equal(source->scores(told), 0);
  }
}

}  // namespace
}  // namespace flexrf::job_scores_test

int main() {
  using namespace flexrf::job_scores_test;
  const CMUnitTest tests[] = {
      cmocka_unit_test(the_highest_come_first_and_nothing_is_taken),
      cmocka_unit_test(as_many_are_told_as_there_is_room_for),
      cmocka_unit_test(scores_of_all_kinds_are_told),
      cmocka_unit_test(without_a_score_none_are_told),
  };
  return cmocka_run_group_tests_name("job scores", tests, nullptr, nullptr);
}
