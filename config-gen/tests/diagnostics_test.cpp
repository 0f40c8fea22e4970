// What is printed of many messages.
#include "config-gen/model/diagnostics.hpp"

#include <cstring>
#include <sstream>
#include <string>

#include "config-gen/model/limits.hpp"
#include "tests/cmocka.hpp"

namespace flexrf::config_gen::diagnostics_test {
namespace {

Position line(std::size_t number) {
  return {intern("cell.toml"), static_cast<std::uint32_t>(number), 1};
}

std::string printed(const Diagnostics& diagnostics) {
  std::ostringstream text;
  diagnostics.print(text);
  return text.str();
}

std::size_t times(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

void many_messages_are_cut_and_counted(void**) {
  Diagnostics diagnostics;
  for (std::size_t i = 1; i <= 2 * max_messages_shown; ++i) diagnostics.warning(line(i), "one", "mend it");
  diagnostics.error(line(10'000), "the last", "mend it");
  const std::string text = printed(diagnostics);
  assert_int_equal(times(text, ": warning: "), max_messages_shown - 1);
  assert_non_null(strstr(text.c_str(), "cell.toml:10000:1: error: the last\n"));
  assert_non_null(strstr(text.c_str(), "config-gen: 101 more messages are not shown\n"));
  assert_false(diagnostics.gave_up());
}

void what_is_alike_is_told_once(void**) {
  Diagnostics diagnostics;
  for (std::size_t i = 0; i < 50; ++i)
    diagnostics.error(line(1), "slot 'tracks[" + std::to_string(i) + "]' is wrong", "mend it");
  assert_string_equal(printed(diagnostics).c_str(),
                      "cell.toml:1:1: error: slot 'tracks[0]' is wrong (and 49 more like it)\n"
                      "cell.toml:1:1: hint: mend it\n");
}

void a_message_is_one_line_whatever_it_quotes(void**) {
  Diagnostics diagnostics;
  diagnostics.error({intern("odd\nfolder/cell.toml"), 1, 2}, "saw 't\n'", "not \x1b[31m");
  assert_string_equal(printed(diagnostics).c_str(),
                      "odd\\nfolder/cell.toml:1:2: error: saw 't\\n'\n"
                      "odd\\nfolder/cell.toml:1:2: hint: not \\x1B[31m\n");
}

bool gives_up_after(Diagnostics& diagnostics, std::size_t errors, bool alike) {
  std::size_t added = 0;
  try {
    for (; added < 2 * errors; ++added)
      diagnostics.error(line(alike ? 1 : added + 1), "x[" + std::to_string(added) + "]", "mend it");
  } catch (const GivenUp&) {
    // At the one that is too many.
  }
  return diagnostics.gave_up() && added == errors;
}

void too_many_errors_end_it(void**) {
  Diagnostics different, alike;
  assert_true(gives_up_after(different, max_errors, false));
  assert_true(gives_up_after(alike, max_errors_alike, true));
  assert_int_equal(times(printed(different), ": error: "), max_messages_shown);
  assert_non_null(strstr(printed(different).c_str(), "config-gen: what follows was not looked at"));
  assert_int_equal(times(printed(alike), ": error: "), 1);
}

// Warnings change nothing: good tables that earn many are good.
void too_many_warnings_do_not(void**) {
  Diagnostics diagnostics;
  for (std::size_t i = 1; i <= 2 * max_errors; ++i) diagnostics.warning(line(i), "one", "mend it");
  assert_false(diagnostics.gave_up());
  assert_false(diagnostics.failed());
  assert_non_null(strstr(printed(diagnostics).c_str(), "config-gen: 1900 more messages are not shown\n"));
}

}  // namespace
}  // namespace flexrf::config_gen::diagnostics_test

int main() {
  using namespace flexrf::config_gen::diagnostics_test;
  const CMUnitTest tests[] = {
      cmocka_unit_test(many_messages_are_cut_and_counted), cmocka_unit_test(what_is_alike_is_told_once),
      cmocka_unit_test(a_message_is_one_line_whatever_it_quotes), cmocka_unit_test(too_many_errors_end_it),
      cmocka_unit_test(too_many_warnings_do_not)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
