// The panel's options: when there is a panel, and that names of drivers' options cannot be among them.
#include "web-ui/server/panel_options.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "config-gen/model/own_options.hpp"
#include "runtime/executive/options.hpp"
#include "tests/cmocka.hpp"
#include "web-ui/server/panel.hpp"

namespace flexrf::panel {
namespace {

Application empty_application() {
  Application application{};
  application.name = "cell";
  application.summary = "For tests.";
  return application;
}

/// "yes", "no", or why the start is refused.
std::string panel_with(std::vector<std::string> words) {
  words.insert(words.begin(), "cell");
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  const Result<Options> options =
      parse_options(empty_application(), &observer, static_cast<int>(arguments.size()), arguments.data());
  if (!options) return options.status().cause();
  return options->observed ? "yes" : "no";
}

void check_panel(const std::vector<std::string>& words, const char* expected) {
  assert_string_equal(panel_with(words).c_str(), expected);
}

// [exec-41] [exec-76]
void there_is_one_unless_it_is_off_or_time_is_virtual(void**) {
  check_panel({}, "yes");
  check_panel({"--panel", "127.0.0.1:0"}, "yes");
  check_panel({"--panel", "off"}, "no");
  check_panel({"--virtual-time", "1s"}, "no");
  check_panel({"--virtual-time", "1s", "--panel", "off"}, "no");
}

void what_cannot_be_is_refused(void**) {
  check_panel({"--panel", "8080"}, "--panel 8080: give ADDRESS:PORT or off");
  check_panel({"--panel", "[::1]:80", "--virtual-time", "1s"},
              "--panel [::1]:80 with --virtual-time: there is no panel on a simulated clock; leave one of "
              "them away");
  check_panel({"--panel-edit-timeout", "5"},
              "--panel-edit-timeout 5: give a duration with its unit (ns, us, ms, s, min, h), as `60s`");
}

/// As --help lists them.
std::vector<std::string> listed_options() {
  std::vector<std::string> names;
  const std::string text = usage(empty_application(), &observer);
  constexpr std::string_view margin = "\n  --";
  for (std::size_t at = text.find(margin); at != std::string::npos; at = text.find(margin, at + 1)) {
    const std::size_t begin = at + margin.size() - 2;
    names.push_back(text.substr(begin, text.find(' ', begin) - begin));
  }
  std::sort(names.begin(), names.end());
  return names;
}

void the_generator_knows_all_names_that_drivers_cannot_have(void**) {
  const std::vector<std::string> known{config_gen::own_options.begin(), config_gen::own_options.end()};
  assert_true(listed_options() == known);
}

}  // namespace
}  // namespace flexrf::panel

int main() {
  using namespace flexrf::panel;
  const CMUnitTest tests[] = {
      cmocka_unit_test(there_is_one_unless_it_is_off_or_time_is_virtual),
      cmocka_unit_test(what_cannot_be_is_refused),
      cmocka_unit_test(the_generator_knows_all_names_that_drivers_cannot_have),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
