#include "runtime/blackboard/history.hpp"

#include "runtime/blackboard/test_types.hpp"
#include "tests/cmocka.hpp"

namespace flexrf::history_test {
namespace {

using test::Sample;

Time at(std::int64_t ns) {
  return Time{Duration{ns}};
}

template <std::size_t K>
struct Past {
  void append(std::uint32_t number, std::int64_t sampled_at) {
    const Sample item{number, 1.5, 1};
    history.append({number, at(sampled_at)}, &item);
  }
  NullReason ask(std::int64_t time) { return history.at(at(time), header, &value); }

  HistoryMemory<Sample, K> memory{};
  History history{&test::sample_type, memory.words, K};
  ItemHeader header{};
  Sample value{};
};

// [board-19]
void empty_history_has_nothing_yet(void**) {
  Past<4> past;
  assert_int_equal(past.ask(100), NullReason::nothing_yet);
  ItemHeader headers[2];
  Sample values[2];
  assert_int_equal(past.history.between(at(0), at(100), headers, values), 0);
}

// [board-2] [board-19]
void at_gives_what_was_true_then(void**) {
  Past<4> past;
  past.append(1, 10);
  past.append(2, 20);
  past.append(3, 30);
  assert_int_equal(past.ask(9), NullReason::nothing_yet);
  assert_int_equal(past.ask(10), NullReason::none);
  assert_int_equal(past.value.number, 1);
  assert_int_equal(past.ask(29), NullReason::none);
  assert_int_equal(past.value.number, 2);
  assert_true(past.value.value == 1.5);
  assert_int_equal(past.value.flag, 1);
  assert_int_equal(past.header.sequence, 2);
  assert_int_equal(nanoseconds(past.header.sampled_at), 20);
  assert_int_equal(past.ask(1'000'000), NullReason::none);
  assert_int_equal(past.value.number, 3);
}

// [board-2] [board-23]
void only_the_last_k_are_kept(void**) {
  Past<3> past;
  for (std::uint32_t number = 1; number <= 1000; ++number) {
    past.append(number, number * 10);
    if (number < 4) continue;
    assert_int_equal(past.ask((number - 2) * 10), NullReason::none);
    assert_int_equal(past.value.number, number - 2);
    assert_int_equal(past.ask((number - 2) * 10 - 1), NullReason::no_longer_kept);
  }
}

void times_need_not_ascend(void**) {
  Past<4> past;
  past.append(1, 30);
  past.append(2, 10);
  past.append(3, 20);
  assert_int_equal(past.ask(25), NullReason::none);
  assert_int_equal(past.value.number, 3);
  assert_int_equal(past.ask(15), NullReason::none);
  assert_int_equal(past.value.number, 2);
}

void between_gives_the_oldest_first_and_as_many_as_fit(void**) {
  Past<5> past;
  for (std::uint32_t number = 1; number <= 8; ++number) past.append(number, number * 10);
  ItemHeader headers[8];
  Sample values[8];
  assert_int_equal(past.history.between(at(0), at(1000), headers, values), 5);
  for (std::uint32_t i = 0; i < 5; ++i) {
    assert_int_equal(values[i].number, 4 + i);
    assert_int_equal(headers[i].sequence, 4 + i);
  }
  assert_int_equal(past.history.between(at(50), at(70), headers, values), 3);
  assert_int_equal(values[0].number, 5);
  assert_int_equal(past.history.between(at(0), at(1000), std::span{headers, 2}, values), 2);
  assert_int_equal(values[1].number, 5);
  assert_int_equal(past.history.between(at(71), at(79), headers, values), 0);
}

/// A writer that was preempted in the middle of an append: the entry it is overwriting is given up, the
/// others are not.
// [board-23]
void an_entry_that_is_being_overwritten_is_not_kept(void**) {
  Past<3> past;
  for (std::uint32_t number = 1; number <= 3; ++number) past.append(number, number * 10);
  past.memory.words[0] = 3 * 2 + 1;  // position 3 begins to take the place of position 0
  assert_int_equal(past.ask(15), NullReason::no_longer_kept);
  assert_int_equal(past.ask(25), NullReason::none);
  assert_int_equal(past.value.number, 2);
  ItemHeader headers[3];
  Sample values[3];
  assert_int_equal(past.history.between(at(0), at(100), headers, values), 2);
  assert_int_equal(values[0].number, 2);
}

}  // namespace
}  // namespace flexrf::history_test

int main() {
  using namespace flexrf::history_test;
  const CMUnitTest tests[] = {
      cmocka_unit_test(empty_history_has_nothing_yet),
      cmocka_unit_test(at_gives_what_was_true_then),
      cmocka_unit_test(only_the_last_k_are_kept),
      cmocka_unit_test(times_need_not_ascend),
      cmocka_unit_test(between_gives_the_oldest_first_and_as_many_as_fit),
      cmocka_unit_test(an_entry_that_is_being_overwritten_is_not_kept),
  };
  return cmocka_run_group_tests_name("history", tests, nullptr, nullptr);
}
