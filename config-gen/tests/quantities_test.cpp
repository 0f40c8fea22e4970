#include "config-gen/read/quantities.hpp"

#include "tests/cmocka.hpp"

namespace flexrf::config_gen::quantities_test {
namespace {

void units_of_measure(void**) {
  for (const char* good : {"1", "m", "rad/s", "m/s^2", "N*m", "kg*m^2", "1/s", "rad/s^3", "K", "Ohm", "px"})
    assert_string_equal(judge_unit(good, false).c_str(), "");
  assert_string_equal(judge_unit("rad/s|m/s", false).c_str(), "");
  assert_string_equal(judge_unit("rad|deg", false).c_str(), "write \"rad\"");
  assert_string_equal(judge_unit("|m", false).c_str(), "write \"1\"");
  assert_string_equal(judge_unit("deg", false).c_str(), "write \"rad\"");
  assert_string_equal(judge_unit("Nm", false).c_str(), "write \"N*m\"");
  assert_string_equal(judge_unit("%", false).c_str(), "write \"1\"");
  assert_string_not_equal(judge_unit("mm", false).c_str(), "");
  assert_string_equal(judge_unit("mm", true).c_str(), "");
  assert_string_equal(judge_unit("ns", true).c_str(), "");
  for (const char* bad : {"m//s", "m^x", "m^", "furlong", "m s"})
    assert_string_not_equal(judge_unit(bad, true).c_str(), "");
}

void symbols_are_replaced(void**) {
  assert_string_equal(replace_symbol("axis/s^2", "axis", "m").c_str(), "m/s^2");
  assert_string_equal(replace_symbol("1/axis", "axis", "rad").c_str(), "1/rad");
  assert_string_equal(replace_symbol("N*axis^2", "axis", "m").c_str(), "N*m^2");
  assert_string_equal(replace_symbol("taxis/s", "axis", "m").c_str(), "taxis/s");
}

void names_of_quantities(void**) {
  for (const char* name : {"position", "homing_velocity", "forces", "rest_time"})
    assert_true(names_quantity(name));
  for (const char* name : {"velocity_share", "positioned", "speed", "gain", "s", ""})
    assert_false(names_quantity(name));
}

}  // namespace
}  // namespace flexrf::config_gen::quantities_test

int main() {
  using namespace flexrf::config_gen::quantities_test;
  const CMUnitTest tests[] = {cmocka_unit_test(units_of_measure), cmocka_unit_test(symbols_are_replaced),
                              cmocka_unit_test(names_of_quantities)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
