#include "hal/gpio/lines/interface/line_filter.hpp"

#include "tests/cmocka.hpp"

namespace flexrf {
namespace {

constexpr Time at(std::int64_t milliseconds) {
  return Time{std::chrono::milliseconds{1000 + milliseconds}};
}

// [line-filter-3]
void the_first_level_counts_at_once(void**) {
  LineFilter filter;
  filter.reset(std::chrono::milliseconds{5});
  filter.put(true, at(0));
  assert_true(filter.on());
  assert_true(filter.since() == at(0));
  assert_true(filter.settles_at() == Time::max());
}

// [line-filter-1]
void bounces_count_for_nothing(void**) {
  LineFilter filter;
  filter.reset(std::chrono::milliseconds{5});
  filter.put(false, at(0));
  for (int i = 0; i < 10; ++i) {
    filter.put(i % 2 == 0, at(10 + i));
    filter.settle(at(10 + i));
    assert_false(filter.on());
  }
  filter.put(true, at(20));
  assert_true(filter.settles_at() == at(25));
  filter.settle(at(24));
  assert_false(filter.on());
  filter.settle(at(25));
  assert_true(filter.on());
  assert_true(filter.since() == at(20));
}

/// However late a cycle learns of them.
// [line-filter-2]
void a_level_that_lasted_counts_though_it_is_over(void**) {
  LineFilter filter;
  filter.reset(std::chrono::milliseconds{5});
  filter.put(false, at(0));
  filter.put(true, at(10));
  filter.put(false, at(16));
  assert_true(filter.on());
  filter.settle(at(20));
  assert_true(filter.on());
  filter.settle(at(21));
  assert_false(filter.on());
  assert_true(filter.since() == at(16));
}

void without_a_time_every_level_counts(void**) {
  LineFilter filter;
  filter.reset(Duration{});
  filter.put(false, at(0));
  filter.put(true, at(1));
  assert_true(filter.on());
  filter.put(false, at(1));
  assert_false(filter.on());
}

}  // namespace
}  // namespace flexrf

int main() {
  using namespace flexrf;
  const CMUnitTest tests[] = {
      cmocka_unit_test(the_first_level_counts_at_once),
      cmocka_unit_test(bounces_count_for_nothing),
      cmocka_unit_test(a_level_that_lasted_counts_though_it_is_over),
      cmocka_unit_test(without_a_time_every_level_counts),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
