#include "config-gen/read/quantities.hpp"

#include <utility>

#include "tests/cmocka.hpp"

namespace flexrf::config_gen::quantities_test {
namespace {

void units_of_measure(void**) {
  for (const char* good : {"1", "m", "rad/s", "m/s^2", "N*m", "kg*m^2", "1/s", "rad/s^3", "K", "Ohm", "px"})
    assert_string_equal(judge_unit(good, UnitUse::si).c_str(), "");
  assert_string_equal(judge_unit("rad/s|m/s", UnitUse::si).c_str(), "");
  assert_string_equal(judge_unit("rad|deg", UnitUse::si).c_str(), "write \"rad\"");
  assert_string_equal(judge_unit("|m", UnitUse::si).c_str(), "write \"1\"");
  assert_string_equal(judge_unit("deg", UnitUse::si).c_str(), "write \"rad\"");
  assert_string_equal(judge_unit("Nm", UnitUse::si).c_str(), "write \"N*m\"");
  assert_string_equal(judge_unit("%", UnitUse::si).c_str(), "write \"1\"");
  assert_string_not_equal(judge_unit("mm", UnitUse::si).c_str(), "");
  assert_string_equal(judge_unit("mm", UnitUse::multiples).c_str(), "");
  assert_string_equal(judge_unit("ns", UnitUse::multiples).c_str(), "");
  for (const char* bad : {"m//s", "m^x", "m^", "furlong", "m s"})
    assert_string_not_equal(judge_unit(bad, UnitUse::multiples).c_str(), "");
}

void units_of_devices(void**) {
  for (const char* good : {"bar", "mbar", "degC", "rpm", "%", "kWh", "l/min", "mm", "deg", "m/s", "ppm", "h"})
    assert_string_equal(judge_unit(good, UnitUse::device).c_str(), "");
  for (const char* bad : {"furlong", "kbars", "mmin", "m//s"})
    assert_string_not_equal(judge_unit(bad, UnitUse::device).c_str(), "");
  assert_string_equal(judge_unit("celsius", UnitUse::device).c_str(), "write \"degC\"");
  assert_string_equal(judge_unit("celsius", UnitUse::si).c_str(), "write \"K\"");
  // What devices are read in is no unit of a table's numbers.
  assert_string_equal(judge_unit("mbar", UnitUse::multiples).c_str(),
                      "write \"Pa\" and give the value in it");
  assert_string_equal(judge_unit("rpm", UnitUse::si).c_str(), "write \"rad/s\"");
}

void units_measure_what_a_name_says(void**) {
  const std::pair<const char*, const char*> good[] = {{"homing_velocity", "m/s"},
                                                      {"velocities", "rad/s|m/s"},
                                                      {"spindle_velocity", "rpm"},
                                                      {"torque", "J"},
                                                      {"load_torque", "kg*m^2/s^2"},
                                                      {"oil_pressure", "bar"},
                                                      {"rest_time", "ns"},
                                                      {"inertia", "kg*m^2"},
                                                      {"counts_per_force", "1/N"},
                                                      {"velocity_share", "kg"},
                                                      {"step", "kg"},
                                                      {"focal_length", "px"},
                                                      {"frequency", "1/s"},
                                                      {"volume", "l"},
                                                      {"power", "VA"},
                                                      {"delay", "h"}};
  for (const auto& [name, unit] : good) assert_string_equal(units_instead(name, unit).c_str(), "");
  assert_string_equal(units_instead("homing_velocity", "kg").c_str(), "\"m/s\" or \"rad/s\" or \"px/s\"");
  assert_string_equal(units_instead("velocity", "m/s|kg").c_str(), "\"m/s\" or \"rad/s\" or \"px/s\"");
  assert_string_equal(units_instead("velocity", "m*s").c_str(), "\"m/s\" or \"rad/s\" or \"px/s\"");
  assert_string_equal(units_instead("force", "N*m").c_str(), "\"N\"");
  assert_string_equal(units_instead("oil_temperature", "bar").c_str(), "\"K\"");
  assert_string_equal(units_instead("rest_times", "m").c_str(), "\"s\"");
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
  const CMUnitTest tests[] = {cmocka_unit_test(units_of_measure), cmocka_unit_test(units_of_devices),
                              cmocka_unit_test(units_measure_what_a_name_says),
                              cmocka_unit_test(symbols_are_replaced), cmocka_unit_test(names_of_quantities)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
