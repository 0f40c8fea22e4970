// What queues promise to one thread at a time; queue_stress.cpp sets threads against each other.
#include "runtime/blackboard/queue.hpp"

#include <limits>
#include <random>

#include "runtime/blackboard/job_queue.hpp"
#include "runtime/blackboard/queue_ring.hpp"
#include "runtime/blackboard/test_types.hpp"
#include "tests/cmocka.hpp"

namespace flexrf::queue_test {
namespace {

using test::Sample;

Time at(std::int64_t ns) {
  return Time{Duration{ns}};
}

template <std::size_t Capacity>
struct Ring {
  explicit Ring(DropPolicy policy, std::span<Doorbell* const> bells = {})
      : ring(&test::sample_type, memory.view(), policy, bells) {}
  bool push(std::uint32_t number) {
    const Sample value{number, 0, 0};
    return ring.push(&value, at(number));
  }
  QueueRingMemory<Sample, Capacity> memory{};
  QueueRing ring;
};

/// The number of the next item, 0 when there is none.
std::uint32_t pop(QueueSource& source, ItemHeader* item = nullptr) {
  Sample value{};
  ItemHeader header{};
  if (!source.pop(&value, header)) return 0;
  if (item != nullptr) *item = header;
  return value.number;
}

void assert_counters(const QueueSink& sink, std::uint64_t pushed, std::uint64_t popped,
                     std::uint64_t dropped) {
  assert_int_equal(sink.counters().pushed, pushed);
  assert_int_equal(sink.counters().popped, popped);
  assert_int_equal(sink.counters().dropped, dropped);
}

// [board-25]
void items_come_out_once_and_in_order(void**) {
  Ring<10> ring{DropPolicy::drop_newest};
  std::uint32_t next_in = 1;
  std::uint32_t next_out = 1;
  for (int round = 0; round < 100; ++round) {
    for (int i = 0; i < round % 11; ++i) assert_true(ring.push(next_in++));
    while (next_out < next_in) {
      ItemHeader header{};
      assert_int_equal(pop(ring.ring, &header), next_out);
      assert_int_equal(header.sequence, next_out);
      assert_int_equal(nanoseconds(header.sampled_at), next_out);
      ++next_out;
    }
    assert_true(ring.ring.is_empty());
    assert_int_equal(pop(ring.ring), 0);
  }
  assert_int_equal(ring.ring.arrivals(), next_in - 1);
  assert_int_equal(ring.ring.departures(), next_out - 1);
  assert_counters(ring.ring, next_in - 1, next_in - 1, 0);
}

// [board-27] [board-28] [board-29]
void drop_newest_refuses_what_comes(void**) {
  Ring<3> ring{DropPolicy::drop_newest};
  for (std::uint32_t number = 1; number < 4; ++number) {
    assert_true(ring.ring.has_room());
    assert_true(ring.push(number));
  }
  assert_false(ring.ring.has_room());
  assert_false(ring.push(4));
  assert_false(ring.push(5));
  assert_counters(ring.ring, 3, 0, 2);
  assert_int_equal(pop(ring.ring), 1);
  assert_true(ring.push(6));
  assert_int_equal(pop(ring.ring), 2);
  assert_int_equal(pop(ring.ring), 3);
  ItemHeader header{};
  assert_int_equal(pop(ring.ring, &header), 6);
  assert_int_equal(header.sequence, 6);  // the gap shows what was dropped
  assert_counters(ring.ring, 4, 4, 2);
}

template <std::size_t Capacity>
void check_drop_oldest() {
  Ring<Capacity> ring{DropPolicy::drop_oldest};
  for (std::uint32_t number = 1; number <= 2 * Capacity + 5; ++number) assert_true(ring.push(number));
  assert_false(ring.ring.has_room());
  assert_counters(ring.ring, 2 * Capacity + 5, 0, Capacity + 5);  // before the reader found out
  assert_int_equal(ring.ring.fill(), Capacity);
  for (std::uint32_t number = Capacity + 6; number <= 2 * Capacity + 5; ++number) {
    assert_int_equal(pop(ring.ring), number);
  }
  assert_int_equal(pop(ring.ring), 0);
  assert_counters(ring.ring, 2 * Capacity + 5, Capacity, Capacity + 5);
}

// [board-27] [board-30]
void drop_oldest_lets_the_reader_skip_what_was_overwritten(void**) {
  check_drop_oldest<1>();
  check_drop_oldest<3>();
  check_drop_oldest<8>();
}

void ring_positions_wrap_around(void**) {
  for (const DropPolicy policy : {DropPolicy::drop_newest, DropPolicy::drop_oldest}) {
    Ring<3> ring{policy};
    ring.ring.start_position_at(~std::uint64_t{0} - 5);
    for (std::uint32_t number = 1; number < 20; ++number) {
      assert_true(ring.push(2 * number));
      assert_true(ring.push(2 * number + 1));
      assert_int_equal(pop(ring.ring), 2 * number);
      assert_int_equal(pop(ring.ring), 2 * number + 1);
    }
    assert_counters(ring.ring, 38, 38, 0);
    for (std::uint32_t number = 1; number < 6; ++number) ring.push(number);
    assert_int_equal(ring.ring.counters().dropped, 2);
  }
}

// [board-39]
void pushing_rings_and_virtual_time_waits_for_commit(void**) {
  Doorbell bell;
  Doorbell* const bells[] = {&bell};
  Ring<4> ring{DropPolicy::drop_newest, bells};
  std::uint32_t heard = bell.listen();
  ring.push(1);
  assert_int_not_equal(bell.listen(), heard);
  ring.ring.set_deferred(true);
  heard = bell.listen();
  ring.push(2);
  ring.push(3);
  assert_int_equal(ring.ring.arrivals(), 1);
  assert_int_equal(pop(ring.ring), 1);
  assert_int_equal(pop(ring.ring), 0);
  assert_int_equal(bell.listen(), heard);
  ring.ring.commit();
  assert_int_not_equal(bell.listen(), heard);
  assert_int_equal(pop(ring.ring), 2);
  assert_int_equal(pop(ring.ring), 3);
  heard = bell.listen();
  ring.ring.commit();
  assert_int_equal(bell.listen(), heard);
}

// [board-3]
void rings_are_drained_in_table_order(void**) {
  Ring<4> first{DropPolicy::drop_newest};
  Ring<4> second{DropPolicy::drop_newest};
  QueueRing* const rings[] = {&first.ring, &second.ring};
  RingSet set{&test::sample_type, rings};
  assert_true(set.is_empty());
  second.push(21);
  first.push(11);
  second.push(22);
  first.push(12);
  assert_false(set.is_empty());
  assert_int_equal(set.fill(), 4);
  assert_int_equal(set.arrivals(), 4);
  assert_int_equal(pop(set), 11);
  assert_int_equal(pop(set), 12);
  assert_int_equal(pop(set), 21);
  assert_int_equal(set.departures(), 3);
  first.push(13);
  assert_int_equal(pop(set), 13);
  assert_int_equal(pop(set), 22);
  assert_int_equal(pop(set), 0);
  assert_ptr_equal(set.type(), &test::sample_type);
}

template <std::size_t Cells>
struct Jobs {
  explicit Jobs(DropPolicy policy, JobOrder order = {}, std::span<Doorbell* const> bells = {})
      : queue(&test::sample_type, memory.view(), policy, order, bells) {}
  static bool push(JobSink& sink, std::uint32_t number, double score = 0) {
    const Sample value{number, score, 0};
    return sink.push(&value, at(number));
  }
  JobQueueMemory<Sample, Cells> memory{};
  JobQueue queue;
  JobSink one{&queue};
  JobSink two{&queue};
};

constexpr JobOrder by_value{true, Scalar::f64, offsetof(Sample, value)};

// [board-31]
void jobs_of_several_writers_come_out_in_order_of_arrival(void**) {
  Jobs<7> jobs{DropPolicy::drop_newest};
  jobs.queue.start_tickets_at((std::uint64_t{1} << 62) - 20);  // wraps around in the cells' words
  std::uint32_t number = 1;
  std::uint32_t expected = 1;
  std::mt19937 random{1};
  for (int round = 0; round < 200; ++round) {
    JobSink& sink = random() % 2 == 0 ? jobs.one : jobs.two;
    if (number - expected < 7 && random() % 3 != 0) {
      assert_true(jobs.one.has_room());
      assert_true(Jobs<7>::push(sink, number++));
    } else if (expected < number) {
      ItemHeader header{};
      assert_int_equal(pop(jobs.queue, &header), expected);
      assert_int_equal(nanoseconds(header.sampled_at), expected);
      ++expected;
    }
    assert_int_equal(jobs.queue.is_empty(), expected == number);
    assert_int_equal(jobs.queue.fill(), number - expected);
  }
  assert_int_equal(jobs.queue.arrivals(), number - 1);
  assert_int_equal(jobs.queue.departures(), expected - 1);
  assert_int_equal(jobs.one.counters().pushed + jobs.two.counters().pushed, number - 1);
  assert_int_equal(jobs.one.counters().popped + jobs.two.counters().popped, expected - 1);
}

// [board-27] [board-32]
void full_job_queue_refuses_the_newest_or_gives_up_the_oldest(void**) {
  Jobs<2> newest{DropPolicy::drop_newest};
  assert_true(Jobs<2>::push(newest.one, 1));
  assert_true(Jobs<2>::push(newest.one, 2));
  assert_false(newest.two.has_room());
  assert_false(Jobs<2>::push(newest.two, 3));
  assert_counters(newest.one, 2, 0, 0);
  assert_counters(newest.two, 0, 0, 1);
  assert_int_equal(pop(newest.queue), 1);

  Jobs<2> oldest{DropPolicy::drop_oldest};
  Jobs<2>::push(oldest.one, 1);
  Jobs<2>::push(oldest.one, 2);
  assert_true(Jobs<2>::push(oldest.two, 3));
  assert_counters(oldest.one, 2, 0, 1);  // counted for whose item it was
  assert_counters(oldest.two, 1, 0, 0);
  assert_int_equal(pop(oldest.queue), 2);
  assert_int_equal(pop(oldest.queue), 3);
}

// [board-33]
void highest_score_comes_out_first_and_equals_by_arrival(void**) {
  Jobs<6> jobs{DropPolicy::drop_newest, by_value};
  const double scores[] = {-1, 3, 0, 3, -1e300, 1e-300};
  for (std::uint32_t i = 0; i < 6; ++i) assert_true(Jobs<6>::push(jobs.one, i + 1, scores[i]));
  for (const std::uint32_t expected : {2U, 4U, 6U, 3U, 1U, 5U}) assert_int_equal(pop(jobs.queue), expected);
}

// [board-27] [board-34]
void full_job_queue_by_score_drops_the_lowest(void**) {
  Jobs<3> jobs{DropPolicy::drop_newest, by_value};
  Jobs<3>::push(jobs.one, 1, 5);
  Jobs<3>::push(jobs.one, 2, 2);
  Jobs<3>::push(jobs.one, 3, 2);
  assert_false(Jobs<3>::push(jobs.two, 4, 1));
  assert_false(Jobs<3>::push(jobs.two, 5, 2));
  assert_counters(jobs.two, 0, 0, 2);
  assert_true(Jobs<3>::push(jobs.two, 6, 3));  // of the two equal ones the later goes
  assert_counters(jobs.one, 3, 0, 1);
  assert_int_equal(pop(jobs.queue), 1);
  assert_int_equal(pop(jobs.queue), 6);
  assert_int_equal(pop(jobs.queue), 2);
  assert_int_equal(pop(jobs.queue), 0);
  assert_counters(jobs.one, 3, 2, 1);
  assert_counters(jobs.two, 1, 1, 2);
}

template <class T>
void check_scores(Scalar scalar, std::initializer_list<T> ascending) {
  static_assert(sizeof(T) <= 8);
  const JobOrder order{true, scalar, offsetof(Sample, value)};
  for (const T* low = ascending.begin(); low + 1 != ascending.end(); ++low) {
    for (const bool low_first : {true, false}) {
      Jobs<2> jobs{DropPolicy::drop_newest, order};
      Sample values[2] = {{1, 0, 0}, {2, 0, 0}};
      std::memcpy(&values[0].value, low, sizeof(T));
      std::memcpy(&values[1].value, low + 1, sizeof(T));
      jobs.one.push(&values[low_first ? 0 : 1], at(1));
      jobs.one.push(&values[low_first ? 1 : 0], at(2));
      assert_int_equal(pop(jobs.queue), 2);
      assert_int_equal(pop(jobs.queue), 1);
    }
  }
}

template <class T>
void check_integers(Scalar scalar) {
  using Limits = std::numeric_limits<T>;
  if constexpr (Limits::is_signed) {
    check_scores<T>(scalar, {Limits::min(), -1, 0, 1, 2, Limits::max()});
  } else {
    check_scores<T>(scalar, {0, 1, 2, 3, 4, Limits::max()});
  }
}

// [board-35]
void a_score_may_be_any_number(void**) {
  using Double = std::numeric_limits<double>;
  using Float = std::numeric_limits<float>;
  check_scores<double>(Scalar::f64, {Double::quiet_NaN(), -Double::infinity(), -1e300, -1, -1e-300, 0, 1e-300,
                                     1, 1 + 1e-14, 1e300, Double::infinity()});
  check_scores<float>(Scalar::f32, {-Float::quiet_NaN(), -Float::infinity(), -1, -Float::denorm_min(), 0,
                                    Float::denorm_min(), 1, 1 + Float::epsilon(), Float::infinity()});
  check_integers<std::int8_t>(Scalar::i8);
  check_integers<std::uint8_t>(Scalar::u8);
  check_integers<std::int16_t>(Scalar::i16);
  check_integers<std::uint16_t>(Scalar::u16);
  check_integers<std::int32_t>(Scalar::i32);
  check_integers<std::uint32_t>(Scalar::u32);
  check_integers<std::int64_t>(Scalar::i64);
  check_integers<std::uint64_t>(Scalar::u64);
  check_scores<bool>(Scalar::boolean, {false, true});

  Jobs<2> zeros{DropPolicy::drop_newest, by_value};
  Jobs<2>::push(zeros.one, 1, -0.0);
  Jobs<2>::push(zeros.one, 2, 0.0);
  assert_int_equal(pop(zeros.queue), 1);
}

// [board-39]
void jobs_wait_for_commit_in_virtual_time(void**) {
  Doorbell bell;
  Doorbell* const bells[] = {&bell};
  Jobs<4> jobs{DropPolicy::drop_newest, {}, bells};
  jobs.one.set_deferred(true);
  jobs.two.set_deferred(true);
  const std::uint32_t heard = bell.listen();
  Jobs<4>::push(jobs.one, 1);
  Jobs<4>::push(jobs.two, 2);
  Jobs<4>::push(jobs.one, 3);
  assert_true(jobs.queue.is_empty());
  assert_int_equal(jobs.queue.arrivals(), 0);
  assert_int_equal(bell.listen(), heard);
  jobs.two.commit();
  assert_int_equal(pop(jobs.queue), 2);
  assert_int_equal(pop(jobs.queue), 0);
  jobs.one.commit();
  assert_int_not_equal(bell.listen(), heard);
  assert_int_equal(pop(jobs.queue), 1);
  assert_int_equal(pop(jobs.queue), 3);
  jobs.one.commit();
  assert_int_equal(jobs.queue.arrivals(), 3);
}

/// Its place is taken before what takes it can be seen.
// [board-44]
void what_is_pushed_displaces_its_victim_before_commit(void**) {
  Ring<2> ring{DropPolicy::drop_oldest};
  Jobs<2> jobs{DropPolicy::drop_oldest};
  for (std::uint32_t number = 1; number < 4; ++number) {
    ring.ring.set_deferred(number == 3);
    jobs.one.set_deferred(number == 3);
    assert_true(ring.push(number) && Jobs<2>::push(jobs.one, number));
  }
  for (const std::uint32_t seen : {2U, 0U}) assert_true(pop(ring.ring) == seen && pop(jobs.queue) == seen);
  ring.ring.commit();
  jobs.one.commit();
  assert_true(pop(ring.ring) == 3 && pop(jobs.queue) == 3);
  assert_counters(ring.ring, 3, 2, 1);
  assert_counters(jobs.one, 3, 2, 1);
}

std::uint64_t digest_of(QueueSink& sink, std::uint32_t first) {
  sink.set_digested(true);
  for (std::uint32_t i = 0; i < 3; ++i) {
    const Sample value{first + i, 0, 0};
    sink.push(&value, at(i));
  }
  return sink.digest();
}

void digest_covers_what_was_accepted(void**) {
  Ring<2> ring{DropPolicy::drop_newest};
  Ring<2> same{DropPolicy::drop_newest};
  Ring<2> other{DropPolicy::drop_newest};
  Ring<4> larger{DropPolicy::drop_newest};
  const std::uint64_t digest = digest_of(ring.ring, 1);
  assert_int_equal(digest, digest_of(same.ring, 1));
  assert_int_not_equal(digest, digest_of(other.ring, 2));
  assert_int_not_equal(digest, digest_of(larger.ring, 1));
  Jobs<2> jobs{DropPolicy::drop_newest};
  assert_int_equal(digest, digest_of(jobs.one, 1));
}

}  // namespace
}  // namespace flexrf::queue_test

int main() {
  using namespace flexrf::queue_test;
  const CMUnitTest tests[] = {
      cmocka_unit_test(items_come_out_once_and_in_order),
      cmocka_unit_test(drop_newest_refuses_what_comes),
      cmocka_unit_test(drop_oldest_lets_the_reader_skip_what_was_overwritten),
      cmocka_unit_test(ring_positions_wrap_around),
      cmocka_unit_test(pushing_rings_and_virtual_time_waits_for_commit),
      cmocka_unit_test(rings_are_drained_in_table_order),
      cmocka_unit_test(jobs_of_several_writers_come_out_in_order_of_arrival),
      cmocka_unit_test(full_job_queue_refuses_the_newest_or_gives_up_the_oldest),
      cmocka_unit_test(highest_score_comes_out_first_and_equals_by_arrival),
      cmocka_unit_test(full_job_queue_by_score_drops_the_lowest),
      cmocka_unit_test(a_score_may_be_any_number),
      cmocka_unit_test(jobs_wait_for_commit_in_virtual_time),
      cmocka_unit_test(what_is_pushed_displaces_its_victim_before_commit),
      cmocka_unit_test(digest_covers_what_was_accepted),
  };
  return cmocka_run_group_tests_name("queue", tests, nullptr, nullptr);
}
