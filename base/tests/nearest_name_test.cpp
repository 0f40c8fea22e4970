#include "base/nearest_name.hpp"

#include "tests/cmocka.hpp"

namespace flexrf::nearest_name_test {
namespace {

void names_are_compared_by_edits(void**) {
  assert_int_equal(edit_distance("", ""), 0);
  assert_int_equal(edit_distance("step", "step"), 0);
  assert_int_equal(edit_distance("step", "stpe"), 1);
  assert_int_equal(edit_distance("kitten", "sitting"), 3);
  assert_int_equal(edit_distance("", "abc"), 3);
  NearestName nearest("enbled");
  nearest.offer("mode");
  nearest.offer("enabled");
  nearest.offer("disabled");
  assert_true(nearest.best() == "enabled");
  NearestName nothing("zzz");
  nothing.offer("mode");
  assert_true(nothing.best().empty());
  NearestName letter("x");
  letter.offer("y");
  assert_true(letter.best().empty());
}

}  // namespace
}  // namespace flexrf::nearest_name_test

int main() {
  using namespace flexrf::nearest_name_test;
  const CMUnitTest tests[] = {cmocka_unit_test(names_are_compared_by_edits)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
