#include "hal/operator/keyboard/terminal/key_decoder.hpp"

#include <string>
#include <vector>

#include "tests/cmocka.hpp"

namespace {

using namespace flexrf;

std::vector<KeyEvent> decode(const std::string& bytes, bool then_nothing = true) {
  KeyDecoder decoder;
  std::vector<KeyEvent> events;
  const auto take = [&] {
    while (const auto event = decoder.take()) events.push_back(*event);
  };
  for (const char byte : bytes) {
    decoder.put(static_cast<std::uint8_t>(byte));
    take();
  }
  if (then_nothing) decoder.decide();
  take();
  return events;
}

bool gives(const std::string& bytes, const std::vector<KeyEvent>& expected, bool then_nothing = true) {
  const std::vector<KeyEvent> events = decode(bytes, then_nothing);
  if (events.size() != expected.size()) return false;
  for (std::size_t i = 0; i < events.size(); ++i) {
    if (events[i].key != expected[i].key || events[i].character != expected[i].character) return false;
  }
  return true;
}

constexpr KeyEvent w{Key::character, 'w'};

void characters_are_themselves(void**) {
  assert_true(gives("w w", {w, {Key::character, ' '}, w}));
  assert_true(
      gives("\r\t\x7F\b", {{Key::enter, 0}, {Key::tab, 0}, {Key::backspace, 0}, {Key::backspace, 0}}));
  assert_true(gives(std::string("\x01\x02\0w", 4), {w}));
}

void sequences_are_keys(void**) {
  assert_true(
      gives("\x1B[A\x1B[B\x1B[C\x1B[D", {{Key::up, 0}, {Key::down, 0}, {Key::right, 0}, {Key::left, 0}}));
  assert_true(gives("\x1BOA\x1BOHw", {{Key::up, 0}, {Key::home, 0}, w}));
  assert_true(gives("\x1B[3~\x1B[5~\x1B[6~\x1B[2~",
                    {{Key::delete_key, 0}, {Key::page_up, 0}, {Key::page_down, 0}, {Key::insert, 0}}));
  assert_true(gives("\x1B[1;5A", {{Key::up, 0}}));  // with Ctrl held
  assert_true(gives("\x1B[99~\x1B[?25hw", {w}));    // unknown ones are nothing
}

void an_escape_is_decided_by_what_comes_after(void**) {
  assert_true(gives("\x1B", {}, false));
  assert_true(gives("\x1B", {{Key::escape, 0}}));
  assert_true(gives("\x1Bw", {{Key::escape, 0}, w}));
  assert_true(gives("\x1B\x1B[A", {{Key::escape, 0}, {Key::up, 0}}));
  assert_true(gives("\x1B[", {}));  // cut: nothing
  assert_true(gives("\x1B[\nw", {{Key::enter, 0}, w}));
}

void long_numbers_do_no_harm(void**) {
  assert_true(gives("\x1B[" + std::string(100, '9') + "~w", {w}));
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(characters_are_themselves),
      cmocka_unit_test(sequences_are_keys),
      cmocka_unit_test(an_escape_is_decided_by_what_comes_after),
      cmocka_unit_test(long_numbers_do_no_harm),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
