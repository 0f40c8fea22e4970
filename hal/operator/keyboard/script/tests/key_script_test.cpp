#include "hal/operator/keyboard/script/key_script.hpp"

#include <cstring>

#include "hal/driver/device_bench.hpp"
#include "hal/operator/keyboard/script/script_keyboard.hpp"
#include "tests/cmocka.hpp"

namespace {

using namespace flexrf;

bool refuses(const char* text, const char* expected) {
  const auto result = parse_key_script(text, "keys.txt");
  if (!result && std::strcmp(result.status().cause(), expected) == 0) return true;
  print_message("expected: %s\n     got: %s\n", expected, result.status().cause());
  return false;
}

bool reads_a_script() {
  const auto script =
      parse_key_script("# drive\n0.5 w\n\n 0.5\td   # at once\n1 up\r\n2e0 space\n3 hash", "keys.txt");
  if (!script || script->size() != 5) return false;
  const std::vector<ScriptedKey>& keys = *script;
  return keys[0].after == std::chrono::milliseconds(500) && keys[0].event.character == 'w' &&
         keys[1].event.character == 'd' && keys[2].event.key == Key::up && keys[3].event.character == ' ' &&
         keys[4].event.character == '#' && keys[4].after == std::chrono::seconds(3);
}

void lines_are_keys(void**) {
  assert_true(reads_a_script());
}

void errors_cite_their_line(void**) {
  assert_true(refuses("0.5 w\nsoon d\n",
                      "keys.txt:2: not a time in seconds: 'soon'; a line is seconds and a key, as '0.5 w'"));
  assert_true(
      refuses("-1 w", "keys.txt:1: not a time in seconds: '-1'; a line is seconds and a key, as '0.5 w'"));
  assert_true(
      refuses("nan w", "keys.txt:1: not a time in seconds: 'nan'; a line is seconds and a key, as '0.5 w'"));
  assert_true(refuses("\n\n1 ww", "keys.txt:3: not a key: 'ww'; a line is seconds and a key, as '0.5 w'"));
  assert_true(refuses("1", "keys.txt:1: not a key: ''; a line is seconds and a key, as '0.5 w'"));
  assert_true(refuses("1 w d", "keys.txt:1: more than a key: 'd'; a line is seconds and a key, as '0.5 w'"));
  assert_true(
      refuses("1 w\n0.9 d",
              "keys.txt:2: earlier than the line before: '0.9'; a line is seconds and a key, as '0.5 w'"));
}

bool driver_says_what_is_missing() {
  DeviceBench<ScriptKeyboard> bench(nullptr);
  const Status without = bench.driver().initialise();
  const GivenOption keys{script_keyboard_driver_options, "/nowhere/keys.txt"};
  bench.environment().options = OptionValues{{&keys, 1}};
  const Status absent = bench.driver().initialise();
  return without.code() == StatusCode::invalid_argument &&
         std::strstr(without.cause(), "--keys FILE") != nullptr && absent.code() == StatusCode::not_found &&
         std::strstr(absent.cause(), "/nowhere/keys.txt") != nullptr;
}

void missing_scripts_are_named(void**) {
  assert_true(driver_says_what_is_missing());
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(lines_are_keys),
      cmocka_unit_test(errors_cite_their_line),
      cmocka_unit_test(missing_scripts_are_named),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
