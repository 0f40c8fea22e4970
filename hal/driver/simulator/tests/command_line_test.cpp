#include "hal/driver/simulator/command_line.hpp"

#include <string>

#include "tests/cmocka.hpp"

namespace flexrf {
namespace {

/// A command line of these words behind the program's name.
struct Line {
  explicit Line(std::vector<std::string> given) : texts(std::move(given)) {
    texts.insert(texts.begin(), "simulator");
    for (std::string& text : texts) words.push_back(text.data());
  }
  CommandLine read() { return {static_cast<int>(words.size()), words.data()}; }

  std::vector<std::string> texts;
  std::vector<char*> words;
};

void options_are_taken_wherever_they_stand(void**) {
  Line words({"--rate", "7.5", "--once", "--serial", "/dev/ttyS0", "19200", "--name", "left"});
  CommandLine line = words.read();
  double rate = 1;
  double baud = 0;
  assert_string_equal(line.word_and_number("--serial", 1200, 921600, baud), "/dev/ttyS0");
  assert_string_equal(line.word("--name"), "left");
  assert_true(line.has("--once"));
  assert_false(line.is_understood());
  line.number("--rate", 1, 8, rate);
  assert_true(line.is_understood());
  assert_true(rate == 7.5 && baud == 19200);
}

void what_is_not_there_leaves_what_was(void**) {
  Line words({});
  CommandLine line = words.read();
  double rate = 3;
  line.number("--rate", 1, 8, rate);
  assert_true(rate == 3);
  assert_null(line.word("--name"));
  assert_null(line.word_and_number("--serial", 0, 1, rate));
  assert_false(line.has("--once"));
  assert_true(line.is_understood());
}

void the_last_of_several_counts(void**) {
  Line words({"--unit", "1", "--unit", "2"});
  CommandLine line = words.read();
  double unit = 0;
  line.number("--unit", 1, 9, unit);
  assert_true(line.is_understood());
  assert_true(unit == 2);
}

void what_is_no_number_in_its_range_is_not_understood(void**) {
  for (const char* text : {"0", "9", "2x", "", "--once"}) {
    Line words({"--unit", text});
    CommandLine line = words.read();
    double unit = 0;
    line.number("--unit", 1, 8, unit);
    assert_false(line.is_understood());
  }
}

void an_option_without_its_words_is_not_understood(void**) {
  Line words({"--serial", "/dev/ttyS0"});
  CommandLine line = words.read();
  double baud = 0;
  assert_null(line.word_and_number("--serial", 1200, 921600, baud));
  assert_false(line.is_understood());
}

}  // namespace
}  // namespace flexrf

int main() {
  using namespace flexrf;
  const CMUnitTest tests[] = {
      cmocka_unit_test(options_are_taken_wherever_they_stand),
      cmocka_unit_test(what_is_not_there_leaves_what_was),
      cmocka_unit_test(the_last_of_several_counts),
      cmocka_unit_test(what_is_no_number_in_its_range_is_not_understood),
      cmocka_unit_test(an_option_without_its_words_is_not_understood),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
