#include "config-gen/model/words.hpp"

#include "tests/cmocka.hpp"

namespace flexrf::config_gen::words_test {
namespace {

void names(void**) {
  assert_true(is_snake_case("tool_pose2"));
  for (const char* bad : {"", "Tool", "2tool", "tool__pose", "tool_", "_tool", "tool-pose", "tööl"})
    assert_false(is_snake_case(bad));
  assert_true(is_camel_case("KeyEvent"));
  for (const char* bad : {"", "keyEvent", "Key_Event", "2Key"}) assert_false(is_camel_case(bad));
  assert_true(is_keyword("operator"));
  assert_true(is_keyword("co_await"));
  assert_true(is_macro("errno"));
  assert_true(is_macro("EOF"));
  assert_true(is_macro("PRId64"));
  assert_false(is_macro("Eof"));
  assert_false(is_macro("X"));
  assert_false(is_keyword("step"));
}

void spellings(void**) {
  assert_string_equal(camel_case("key_event").c_str(), "KeyEvent");
  assert_string_equal(snake_case("KeyEvent").c_str(), "key_event");
  assert_string_equal(snake_case(camel_case("robot_control")).c_str(), "robot_control");
}

void nearest_word(void**) {
  const std::vector<std::string> known = {"priority", "period", "phase", "units"};
  assert_string_equal(nearest("priorty", known).c_str(), "priority");
  assert_string_equal(nearest("peroid", known).c_str(), "period");
  assert_string_equal(nearest("unit", known).c_str(), "units");
  assert_string_equal(nearest("wavelength", known).c_str(), "");
  assert_string_equal(nearest("x", {}).c_str(), "");
}

void suggestions(void**) {
  assert_string_equal(suggest("jgo", {"jog", "arm"}, "units", "none").text.c_str(), "did you mean 'jog'?");
  assert_string_equal(suggest("camera", {"jog", "arm"}, "units", "none").text.c_str(),
                      "known units: 'arm', 'jog'");
  assert_string_equal(suggest("camera", {}, "units", "declare it").text.c_str(), "declare it");
}

bool is_sure(const char* found, const std::vector<std::string>& known) {
  const Hint hint = suggest(found, known, "names", "none");
  assert_true(hint.replacement.has_value());
  assert_string_equal(hint.replacement->found.c_str(), found);
  return hint.replacement->doubt.empty();
}

void a_replacement_is_sure_of_slips_only(void**) {
  assert_true(is_sure("wantd", {"wanted"}));
  assert_true(is_sure("jgo", {"jog", "arm"}));
  assert_true(is_sure("acceleraton_limt", {"acceleration_limit"}));
  assert_true(is_sure("mininterval", {"min_interval"}));
  assert_true(is_sure("robotarm", {"RobotArm"}));
  assert_true(is_sure("jog.stpe", {"jog.step"}));
  assert_true(is_sure("diraction", {"direction"}));
  // Other things than what is known, however near.
  assert_false(is_sure("can0", {"can1"}));
  assert_false(is_sure("axis[2].drvie", {"axis[1].drive"}));
  assert_false(is_sure("mm", {"m"}));
  assert_false(is_sure("f32", {"i32"}));
  assert_false(is_sure("minimum_speed", {"maximum_speed"}));
  assert_false(is_sure("lamp", {"clamp"}));
  assert_false(is_sure("left_gripper", {"lift_gripper"}));
  assert_false(is_sure("speed_x", {"speed_y"}));
  assert_false(is_sure("reel", {"real"}));
}

void a_replacement_is_not_sure_between_two(void**) {
  const Hint hint = suggest("lamps", {"lamp", "lamps_a", "lampss"}, "names", "none");
  assert_string_equal(hint.text.c_str(), "did you mean 'lamp'?");
  assert_string_equal(hint.replacement->doubt.c_str(), "'lampss' is as near");
  assert_true(is_sure("lmap", {"lamp", "lamp"}));
  assert_false(suggest("camera", {"jog"}, "names", "none").replacement.has_value());
}

void lists(void**) {
  assert_string_equal(listed({"a"}).c_str(), "'a'");
  assert_string_equal(listed({"a", "b", "c"}).c_str(), "'a', 'b' and 'c'");
}

void quantities_for_people(void**) {
  assert_string_equal(duration_text(7'000'000).c_str(), "7 ms");
  assert_string_equal(duration_text(1'500'000'000).c_str(), "1.5 s");
  assert_string_equal(duration_text(250).c_str(), "250 ns");
  assert_string_equal(size_text(512).c_str(), "512 B");
  assert_string_equal(size_text(64 * 1024).c_str(), "64 KiB");
  assert_string_equal(size_text(1536 * 1024).c_str(), "1.5 MiB");
}

}  // namespace
}  // namespace flexrf::config_gen::words_test

int main() {
  using namespace flexrf::config_gen::words_test;
  const CMUnitTest tests[] = {cmocka_unit_test(names),
                              cmocka_unit_test(spellings),
                              cmocka_unit_test(nearest_word),
                              cmocka_unit_test(suggestions),
                              cmocka_unit_test(a_replacement_is_sure_of_slips_only),
                              cmocka_unit_test(a_replacement_is_not_sure_between_two),
                              cmocka_unit_test(lists),
                              cmocka_unit_test(quantities_for_people)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
