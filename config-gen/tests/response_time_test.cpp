#include "config-gen/check/response_time.hpp"

#include "tests/cmocka.hpp"

namespace flexrf::config_gen {
namespace {

std::int64_t response(const std::vector<Task>& tasks, std::size_t index, std::int64_t limit = 10'000) {
  return response_time(tasks, index, limit).value_or(-1);
}

// Burns, Wellings: "Real-Time Systems and Programming Languages", fixed-priority example: 3/7, 3/12, 5/20.
void textbook(void**) {
  const std::vector<Task> tasks = {{3, 3, 7, 0, 7}, {2, 3, 12, 0, 12}, {1, 5, 20, 0, 20}};
  assert_int_equal(response(tasks, 0), 3);
  assert_int_equal(response(tasks, 1), 6);
  assert_int_equal(response(tasks, 2), 20);
}

void alone(void**) {
  assert_int_equal(response({{1, 4, 10, 0, 10}}, 0), 4);
}

void equal_priorities_delay_each_other(void**) {
  const std::vector<Task> tasks = {{1, 4, 20, 0, 20}, {1, 5, 20, 0, 20}};
  assert_int_equal(response(tasks, 0), 9);
  assert_int_equal(response(tasks, 1), 9);
}

void jitter_adds_interference(void**) {
  const std::vector<Task> steady = {{2, 2, 10, 0, 10}, {1, 8, 30, 0, 30}};
  const std::vector<Task> shaky = {{2, 2, 10, 3, 10}, {1, 8, 30, 0, 30}};
  assert_int_equal(response(steady, 1), 10);
  assert_int_equal(response(shaky, 1), 12);
  assert_int_equal(response(shaky, 0), 5);
}

void overload_has_no_bound(void**) {
  const std::vector<Task> tasks = {{3, 6, 10, 0, 10}, {2, 6, 10, 0, 10}, {1, 5, 10, 0, 10}};
  assert_int_equal(response(tasks, 0), 6);
  assert_int_equal(response(tasks, 1), 18);
  assert_int_equal(response(tasks, 2), -1);
}

}  // namespace
}  // namespace flexrf::config_gen

int main() {
  using namespace flexrf::config_gen;
  const CMUnitTest tests[] = {cmocka_unit_test(textbook), cmocka_unit_test(alone),
                              cmocka_unit_test(equal_priorities_delay_each_other),
                              cmocka_unit_test(jitter_adds_interference),
                              cmocka_unit_test(overload_has_no_bound)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
