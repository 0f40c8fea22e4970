// What a step sees through its ports: one consistent view per step, and why there is none.
#include "runtime/blackboard/ports.hpp"

#include <cstdlib>
#include <new>

#include "runtime/blackboard/queue_ring.hpp"
#include "runtime/blackboard/test_types.hpp"
#include "tests/cmocka.hpp"

static int allocations = 0;

// Counted, because reading and publishing must not allocate. Freed by the free() that the library's own
// operator delete would call.
void* operator new(std::size_t size) {
  ++allocations;
  void* memory = std::malloc(size);
  if (memory == nullptr) std::abort();
  return memory;
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}

namespace flexrf {
namespace {

using test::Sample;

Time at(std::int64_t ns) {
  return Time{Duration{ns}};
}

/// One writer, one reading thread with a unit in it.
template <std::size_t Readers = 1, std::size_t Loans = 1, std::size_t Holds = 0>
struct Cell {
  explicit Cell(Duration max_age = {}, History* history = nullptr) : slot({}, history) {
    output.connect(&context, &slot.control());
    input.connect(&context, InputBinding{&reader, 1, max_age, nullptr});
  }
  void step(std::int64_t now) {
    ++context.step;
    context.now = at(now);
  }
  void publish(std::uint32_t number) { assert_true(output.publish({number, 0, 0})); }

  Slot<Sample, Readers, Loans, Holds> slot;
  SlotReader reader{&slot.control()};
  StepContext context{1, at(1000)};
  Output<Sample> output;
  Input<Sample> input;
};

// [board-15]
void a_step_sees_one_consistent_item(void**) {
  Cell cell;
  cell.publish(1);
  assert_int_equal(cell.input.latest()->number, 1);
  cell.publish(2);
  View<Sample> again = cell.input.latest();
  assert_int_equal(again->number, 1);
  assert_true(again.is_new());
  cell.step(2000);
  assert_int_equal(cell.input.latest()->number, 2);
}

// [board-15]
void nothing_at_the_first_call_stays_nothing_for_the_step(void**) {
  Cell cell;
  assert_false(bool{cell.input.latest()});
  cell.publish(1);
  assert_false(bool{cell.input.latest()});
  cell.step(2000);
  assert_true(bool{cell.input.latest()});
}

// [board-13] [board-17]
void a_view_tells_new_from_old_sequence_missed_and_age(void**) {
  Cell cell;
  cell.output.publish({1, 0, 0}, at(700));
  View<Sample> view = cell.input.latest();
  assert_true(view.is_new());
  assert_int_equal(view.freshness(), Freshness::new_item);
  assert_int_equal(view.sequence(), 1);
  assert_int_equal(view.missed(), 0);
  assert_int_equal(nanoseconds(view.sampled_at()), 700);
  assert_int_equal(view.age().count(), 300);

  cell.step(1500);
  view = cell.input.latest();
  assert_int_equal(view.freshness(), Freshness::old_item);
  assert_int_equal(view.age().count(), 800);
  for (std::uint32_t number = 2; number < 6; ++number) cell.publish(number);
  cell.step(1600);
  view = cell.input.latest();
  assert_true(view.is_new());
  assert_int_equal(view->number, 5);
  assert_int_equal(view.missed(), 3);
  assert_int_equal(nanoseconds(view.sampled_at()), 1500);  // the step's time
  assert_int_equal(cell.input.missed(), 3);
  assert_int_equal(cell.input.read(), 2);
}

// [board-18]
void sixteen_units_of_a_thread_share_one_buffer_each_with_its_cursor(void**) {
  Cell cell;  // one reader: a triple buffer
  Input<Sample> members[16];
  for (Input<Sample>& member : members)
    member.connect(&cell.context, InputBinding{&cell.reader, 1, {}, nullptr});
  for (std::uint32_t round = 1; round < 20; ++round) {
    cell.publish(round);
    cell.step(1000 + round);
    for (std::uint32_t i = 0; i < 16; ++i) {
      if (round % (i + 1) != 0) continue;
      const View<Sample> view = members[i].latest();
      assert_int_equal(view->number, round);
      assert_true(view.is_new());
      assert_int_equal(view.missed(), round == i + 1 ? 0 : i);
    }
  }
}

NullReason reason_with(WriterState state) {
  Cell cell;
  cell.publish(1);
  cell.slot.control().set_writer_state(state);
  return cell.input.latest().reason();
}

// [board-21]
void null_says_why_the_writer_is_silent(void**) {
  assert_int_equal(reason_with(WriterState::waiting), NullReason::none);
  assert_int_equal(reason_with(WriterState::running), NullReason::none);
  assert_int_equal(reason_with(WriterState::stopped), NullReason::writer_stopped);
  assert_int_equal(reason_with(WriterState::faulted), NullReason::writer_faulted);
  assert_int_equal(reason_with(WriterState::retired), NullReason::writer_retired);

  Cell cell;
  cell.publish(1);
  assert_true(bool{cell.input.latest()});
  cell.step(1100);
  cell.slot.control().set_writer_state(WriterState::faulted);
  const View<Sample> null = cell.input.latest();
  assert_false(bool{null});
  assert_int_equal(null.freshness(), Freshness::null);
  cell.slot.control().set_writer_state(WriterState::running);
  assert_false(bool{cell.input.latest()});  // one answer per step
  cell.step(1200);
  assert_true(bool{cell.input.latest()});
}

// [board-19]
void null_says_nothing_yet(void**) {
  Cell cell;
  assert_int_equal(cell.input.latest().reason(), NullReason::nothing_yet);
}

// [board-20]
void null_says_too_old(void**) {
  Cell cell{Duration{100}};
  cell.publish(1);
  cell.step(1100);
  assert_true(bool{cell.input.latest()});
  cell.step(1101);
  assert_int_equal(cell.input.latest().reason(), NullReason::too_old);
  cell.publish(2);
  cell.step(1102);
  assert_int_equal(cell.input.latest()->number, 2);
}

// By another clock, or a writer that is wrong: it would stay new for ever.
// [board-47]
void null_says_ahead_of_time(void**) {
  Cell cell{Duration{100}};
  cell.step(1000);
  cell.output.publish(Sample{1, 0, 0}, at(1100));
  cell.step(1000);
  assert_true(bool{cell.input.latest()});  // as a thread's that runs ahead of this one
  cell.output.publish(Sample{2, 0, 0}, at(1'000'000'000));
  for (const int now : {1001, 2000, 900'000'000}) {
    cell.step(now);
    assert_int_equal(cell.input.latest().reason(), NullReason::ahead_of_time);
  }
  cell.output.publish(Sample{3, 0, 0}, at(900'000'001));
  cell.step(900'000'002);
  assert_int_equal(cell.input.latest()->number, 3);
}

// [board-22]
void null_says_not_registered(void**) {
  Input<Sample> never_connected;
  assert_int_equal(never_connected.latest().reason(), NullReason::not_registered);
  StepContext context{1, at(1)};
  Input<Sample> optional;
  optional.connect(&context, InputBinding{});
  assert_false(optional.is_connected());
  assert_int_equal(optional.latest().reason(), NullReason::not_registered);
  assert_false(bool{optional.kept()});
  optional.keep();
  Sample value{};
  assert_int_equal(optional.at(at(1), value), NullReason::not_registered);
  assert_int_equal(optional.between(at(0), at(1), {}, nullptr), 0);
}

/// Of the same size, so that nothing but its type tells it from what is wanted.
// [board-41]
void null_says_wrong_type(void**) {
  static_assert(sizeof(test::Block<3>) == sizeof(Sample));
  Cell cell;
  cell.publish(1);
  Input<test::Block<3>> other;
  other.connect(&cell.context, InputBinding{&cell.reader, 1, {}, nullptr});
  assert_false(other.is_connected());
  assert_int_equal(other.latest().reason(), NullReason::wrong_type);
  other.keep();
  assert_int_equal(other.kept().reason(), NullReason::wrong_type);
  test::Block<3> value{};
  assert_int_equal(other.at(at(1), value), NullReason::wrong_type);
  assert_int_equal(other.between(at(0), at(1), {}, nullptr), 0);
}

// [board-23]
void null_says_no_longer_kept(void**) {
  static HistoryMemory<Sample, 3> memory;
  History history{&test::sample_type, memory.words, 3};
  Cell cell{{}, &history};
  for (std::uint32_t number = 1; number < 5; ++number) cell.output.publish({number, 0, 0}, at(number * 10));
  Sample value{};
  Time sampled_at{};
  assert_int_equal(cell.input.at(at(34), value, &sampled_at), NullReason::none);
  assert_int_equal(value.number, 3);
  assert_int_equal(nanoseconds(sampled_at), 30);
  assert_int_equal(cell.input.at(at(19), value), NullReason::no_longer_kept);
  ItemHeader headers[4];
  Sample values[4];
  assert_int_equal(cell.input.between(at(30), at(90), headers, values), 2);
  assert_int_equal(values[0].number, 3);
  assert_int_equal(values[1].number, 4);
}

void every_reason_has_a_name(void**) {
  for (int reason = 0; reason <= static_cast<int>(NullReason::ahead_of_time); ++reason) {
    assert_string_not_equal(name_of(static_cast<NullReason>(reason)), "unknown");
  }
  assert_string_equal(name_of(static_cast<NullReason>(200)), "unknown");
}

// [board-16]
void a_hold_keeps_the_view_across_steps(void**) {
  Cell<1, 1, 1> cell;
  assert_false(bool{cell.input.kept()});
  cell.input.keep();
  assert_false(bool{cell.input.kept()});
  cell.publish(1);
  cell.step(1001);
  cell.input.latest();
  cell.input.keep();
  for (std::uint32_t number = 2; number < 10; ++number) {
    cell.publish(number);
    cell.step(1000 + number);
    assert_int_equal(cell.input.latest()->number, number);
    assert_int_equal(cell.input.kept()->number, 1);
    assert_int_equal(cell.input.kept().age().count(), number);
  }
  cell.input.keep();
  cell.input.keep();
  cell.publish(10);
  assert_int_equal(cell.input.kept()->number, 9);
}

void forgetting_makes_the_item_new_again(void**) {
  Cell cell;
  cell.publish(1);
  cell.input.latest();
  cell.publish(2);
  cell.publish(3);
  cell.input.forget();
  cell.step(1001);
  assert_true(cell.input.latest().is_new());
  assert_int_equal(cell.input.latest().missed(), 0);
}

void a_range_reads_all_members_and_may_be_reconnected(void**) {
  Cell one;
  Cell two;
  SlotReader readers[2] = {SlotReader{&one.slot.control()}, SlotReader{&two.slot.control()}};
  Input<Sample> members[2];
  InputRange<Sample> range;
  StepContext context{1, at(1000)};
  one.publish(1);
  one.publish(2);
  for (int life = 0; life < 2; ++life) {
    ++context.step;
    range.connect(&context, InputBinding{readers, 2, {}, members});
    assert_int_equal(range.size(), 2);
    assert_int_equal(range[0].latest()->number, 2);
    assert_true(range[0].latest().is_new());
    assert_int_equal(range[1].latest().reason(), NullReason::nothing_yet);
    int count = 0;
    for (Input<Sample>& member : range) count += member.is_connected() ? 1 : 0;
    assert_int_equal(count, 2);
  }
}

void an_input_that_is_connected_again_begins_anew(void**) {
  Cell cell;
  cell.publish(1);
  cell.publish(2);
  cell.step(1001);
  assert_true(cell.input.latest().is_new());
  cell.step(1002);
  assert_false(cell.input.latest().is_new());
  cell.publish(3);
  cell.publish(4);
  cell.input.connect(&cell.context, InputBinding{&cell.reader, 1, {}, nullptr});
  assert_int_equal(cell.input.read(), 0);
  cell.step(1003);
  const View<Sample> view = cell.input.latest();
  assert_int_equal(view->number, 4);
  assert_true(view.is_new());
  assert_int_equal(view.missed(), 0);
  assert_int_equal(cell.input.read(), 1);
}

// [board-45]
void null_says_that_the_driver_was_not_chosen(void**) {
  Cell cell;
  cell.slot.control().set_writer_state(WriterState::not_chosen);
  assert_int_equal(cell.input.latest().reason(), NullReason::driver_not_chosen);
}

// [board-8] [board-9] [board-13]
void an_unpublished_loan_is_discarded(void**) {
  Cell<1, 2> cell;
  {
    Loan<Sample> loan = cell.output.loan();
    loan->number = 9;
    Loan<Sample> other = cell.output.loan();
    assert_true(bool{other});
    assert_false(bool{cell.output.loan()});
    assert_false(cell.output.publish({1, 0, 0}));
    other = std::move(loan);  // what it had is given back
    assert_true(bool{cell.output.loan()});
  }
  assert_false(bool{cell.input.latest()});
  Loan<Sample> loan = cell.output.loan();
  *loan = {4, 0, 0};
  Loan<Sample> moved{std::move(loan)};
  moved.publish(at(5));
  assert_false(bool{moved});
  Loan<Sample> last = cell.output.loan_last();
  assert_int_equal(last->number, 4);
  last->number = 5;
  last.publish();
  cell.step(1001);
  assert_int_equal(cell.input.latest()->number, 5);
  assert_int_equal(nanoseconds(cell.input.latest().sampled_at()), 1000);
}

// [board-12]
void an_unconnected_output_accepts_and_forgets(void**) {
  Output<Sample> output;
  assert_true(output.publish({}));
  assert_true(output.publish({}, at(1)));
  assert_false(bool{output.loan()});
  assert_false(bool{output.loan_last()});
  QueueOutput<Sample> queue;
  assert_true(queue.push({}));
  assert_true(queue.has_room());
  QueueInput<Sample> input;
  assert_false(input.pop().has_value());
  assert_true(input.is_empty());
}

// [board-26]
void a_queue_output_feeds_every_audience_its_own_queue(void**) {
  static QueueRingMemory<Sample, 2> memory[2];
  QueueRing one{&test::sample_type, memory[0].view(), DropPolicy::drop_newest};
  QueueRing two{&test::sample_type, memory[1].view(), DropPolicy::drop_newest};
  QueueSink* const sinks[] = {&one, &two};
  StepContext context{1, at(70)};
  QueueOutput<Sample> output;
  output.connect(&context, sinks);
  QueueInput<Sample> input;
  input.connect(&two);
  assert_true(output.push({1, 0, 0}));
  assert_true(output.push({2, 0, 0}, at(71)));
  assert_false(output.has_room());
  assert_int_equal(input.pop()->number, 1);
  assert_false(output.push({3, 0, 0}));  // dropped by one of them
  Sample value{};
  ItemHeader header{};
  assert_true(input.pop(value, header));
  assert_int_equal(value.number, 2);
  assert_int_equal(nanoseconds(header.sampled_at), 71);
  assert_int_equal(input.pop()->number, 3);
  assert_true(input.is_empty());
  assert_int_equal(one.counters().dropped, 1);
  assert_int_equal(two.counters().dropped, 0);
}

// [board-4]
void ports_allocate_nothing(void**) {
  Cell<2, 2, 1> cell{Duration{500}};
  const int before = allocations;
  for (std::uint32_t number = 0; number < 100; ++number) {
    cell.step(1000 + number * 100);
    cell.input.latest();
    cell.input.keep();
    if (number % 10 < 3) cell.publish(number);
    cell.output.loan_last();
    cell.slot.control().set_writer_state(number % 2 == 0 ? WriterState::running : WriterState::faulted);
  }
  assert_int_equal(allocations, before);
}

}  // namespace
}  // namespace flexrf

int main() {
  using namespace flexrf;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_step_sees_one_consistent_item),
      cmocka_unit_test(nothing_at_the_first_call_stays_nothing_for_the_step),
      cmocka_unit_test(a_view_tells_new_from_old_sequence_missed_and_age),
      cmocka_unit_test(sixteen_units_of_a_thread_share_one_buffer_each_with_its_cursor),
      cmocka_unit_test(null_says_why_the_writer_is_silent),
      cmocka_unit_test(null_says_nothing_yet),
      cmocka_unit_test(null_says_too_old),
      cmocka_unit_test(null_says_ahead_of_time),
      cmocka_unit_test(null_says_not_registered),
      cmocka_unit_test(null_says_wrong_type),
      cmocka_unit_test(null_says_no_longer_kept),
      cmocka_unit_test(every_reason_has_a_name),
      cmocka_unit_test(a_hold_keeps_the_view_across_steps),
      cmocka_unit_test(forgetting_makes_the_item_new_again),
      cmocka_unit_test(a_range_reads_all_members_and_may_be_reconnected),
      cmocka_unit_test(an_input_that_is_connected_again_begins_anew),
      cmocka_unit_test(null_says_that_the_driver_was_not_chosen),
      cmocka_unit_test(an_unpublished_loan_is_discarded),
      cmocka_unit_test(an_unconnected_output_accepts_and_forgets),
      cmocka_unit_test(a_queue_output_feeds_every_audience_its_own_queue),
      cmocka_unit_test(ports_allocate_nothing),
  };
  return cmocka_run_group_tests_name("ports", tests, nullptr, nullptr);
}
