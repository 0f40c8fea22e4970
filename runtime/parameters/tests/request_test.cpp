#include "runtime/parameters/request.hpp"

#include <cstring>

#include "tests/cmocka.hpp"

namespace flexrf::request_test {
namespace {

void changes_are_added_while_they_fit(void**) {
  static ParameterRequest request;
  request = ParameterRequest{};
  const double value = 0.25;
  assert_true(request.add(3, 8, &value, sizeof(value)));
  assert_true(request.add_presses(4, 2));
  assert_true(request.add_name(5));
  assert_int_equal(request.change_count, 3);
  assert_int_equal(request.value_bytes, 12);
  assert_int_equal(request.changes[0].parameter, 3);
  assert_int_equal(request.changes[0].offset, 8);
  assert_memory_equal(request.values, &value, sizeof(value));
  assert_int_equal(request.changes[1].position, 8);
  assert_int_equal(request.changes[1].size, 4);
  assert_int_equal(request.changes[2].size, 0);

  static const std::byte large[ParameterRequest::max_value_bytes]{};
  assert_false(request.add(6, 0, large, sizeof(large)));
  assert_int_equal(request.change_count, 3);
  assert_true(request.add(6, 0, large, sizeof(large) - 12));
  assert_false(request.add(7, 0, &value, 1));
  while (request.change_count < ParameterRequest::max_changes) assert_true(request.add_name(8));
  assert_false(request.add_name(9));
}

void a_full_queue_is_busy_at_once_and_rings_only_for_what_it_took(void**) {
  static RequestQueue queue;
  static Doorbell bell;
  static ParameterRequest request;
  queue.set_bell(&bell);
  for (std::uint64_t i = 0; i < RequestQueue::capacity; ++i) {
    request.correlation = i;
    const std::uint32_t heard = bell.listen();
    assert_true(queue.push(request));
    assert_int_not_equal(bell.listen(), heard);
  }
  const std::uint32_t heard = bell.listen();
  assert_false(queue.push(request));
  assert_int_equal(bell.listen(), heard);
  assert_int_equal(queue.refused(), 1);
  assert_int_equal(queue.accepted(), RequestQueue::capacity);

  // Room again: order of arrival is kept over cells that were used before.
  assert_true(queue.pop(request));
  assert_int_equal(request.correlation, 0);
  request.correlation = RequestQueue::capacity;
  assert_true(queue.push(request));
  for (std::uint64_t i = 1; i <= RequestQueue::capacity; ++i) {
    assert_true(queue.has_any());
    assert_true(queue.pop(request));
    assert_int_equal(request.correlation, i);
  }
  assert_false(queue.has_any());
  assert_false(queue.pop(request));
}

void answers_that_nobody_fetches_are_counted(void**) {
  static AnswerQueue queue;
  static ParameterAnswer answer;
  static ParameterRequest request;
  request.correlation = 7;
  request.component = 3;
  for (std::uint32_t i = 0; i < AnswerQueue::capacity + 5; ++i)
    queue.push(ParameterAnswer::refused(request, i, 2, "no"));
  assert_int_equal(queue.dropped(), 5);
  for (std::uint32_t i = 0; i < AnswerQueue::capacity; ++i) {
    assert_true(queue.pop(answer));
    assert_int_equal(answer.sequence, i);
  }
  assert_int_equal(answer.correlation, 7);
  assert_int_equal(answer.component, 3);
  assert_int_equal(answer.parameter, 2);
  assert_int_equal(answer.kind, AnswerKind::refused);
  assert_string_equal(answer.reason, "no");
  assert_false(queue.pop(answer));
}

void lease_numbers_grow(void**) {
  const std::uint64_t first = new_lease_number();
  assert_true(first > 0);
  assert_true(new_lease_number() > first);
}

}  // namespace
}  // namespace flexrf::request_test

int main() {
  using namespace flexrf::request_test;
  const CMUnitTest tests[] = {
      cmocka_unit_test(changes_are_added_while_they_fit),
      cmocka_unit_test(a_full_queue_is_busy_at_once_and_rings_only_for_what_it_took),
      cmocka_unit_test(answers_that_nobody_fetches_are_counted),
      cmocka_unit_test(lease_numbers_grow),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
