// The file of declared hosts: its lines, and what becomes of them while the application runs.
#include "web-ui/server/access/host_file.hpp"

#include <sys/stat.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>

#include "tests/cmocka.hpp"
#include "web-ui/server/access/host_watch.hpp"

namespace flexrf::panel::host_file_test {
namespace {

std::string folder;
std::string file;
std::string text;
DeclaredHosts hosts;
std::optional<HostFileWatch> watch;
Time now;

int begin(void**) {
  char name[] = "/tmp/flexrf-hosts-XXXXXX";
  if (mkdtemp(name) == nullptr) return -1;
  folder = name;
  file = folder + "/panel-hosts";
  now = Time{std::chrono::seconds{1000}};
  return 0;
}

int end(void**) {
  watch.reset();
  std::filesystem::remove_all(folder);
  return 0;
}

const char* joined(const std::vector<std::string>& list) {
  text.clear();
  for (const std::string& one : list) text.append(text.empty() ? "" : " ").append(one);
  return text.c_str();
}

void write(const char* lines) {
  std::ofstream(file) << lines;
}

/// The hosts that the watch tells within three intervals; "as before": none.
const char* told() {
  for (int i = 0; i < 3; ++i) {
    now += FileWatch::interval;
    if (const auto list = watch->update(now)) return joined(*list);
  }
  return "as before";
}

void a_line_is_a_host(void**) {
  hosts = parse_hosts("# ours\n\nCELL7.example.org\r\n  203.0.113.7\t\ncell7.EXAMPLE.org\ncell8", "F");
  assert_string_equal(joined(hosts.list), "cell7.example.org 203.0.113.7 cell8");
  assert_true(hosts.damages.empty());
  hosts = parse_hosts("", "F");
  assert_true(hosts.list.empty() && hosts.damages.empty());
}

void a_damaged_line_is_told_and_the_others_count(void**) {
  hosts = parse_hosts("cell7\n# no host\nhttps://cell7/\ncell8 cell9\n203.0.113.300\n203.0.113.7\n", "F");
  assert_string_equal(joined(hosts.list), "cell7 203.0.113.7");
  assert_int_equal(hosts.damages.size(), 3);
  assert_int_equal(hosts.damages[0].find("F:3: 'https://cell7/' is no host: "), 0);
  assert_int_equal(hosts.damages[1].find("F:4: 'cell8 cell9' is no host: "), 0);
  assert_int_equal(hosts.damages[2].find("F:5: '203.0.113.300' is no host: "), 0);
}

void there_are_eight_at_most(void**) {
  hosts = parse_hosts("a\nb\nc\nd\ne\nf\ng\nh\na\ni\n", "F");
  assert_string_equal(joined(hosts.list), "a b c d e f g h");
  assert_int_equal(hosts.damages.size(), 1);
  assert_string_equal(hosts.damages[0].c_str(), "F:10: 'i' is one too many: at most 8 hosts are declared");
}

void a_list_is_separated_by_blanks(void**) {
  static Result<std::vector<std::string>> list = std::vector<std::string>{};
  list = split_hosts("  cell7 \t203.0.113.7\nCELL7 ");
  assert_string_equal(joined(*list), "cell7 203.0.113.7");
  list = split_hosts(" ");
  assert_true(list && list->empty());
  assert_int_equal(split_hosts("cell7 cell8:80").status().code(), StatusCode::invalid_argument);
  assert_int_equal(split_hosts("a b c d e f g h i").status().code(), StatusCode::out_of_range);
}

void what_is_written_is_read(void**) {
  assert_true(write_hosts(file, {"cell7", "203.0.113.7"}).is_ok());
  struct stat status {};
  assert_int_equal(stat(file.c_str(), &status), 0);
  assert_int_equal(status.st_mode & 0777, 0644);
  hosts = *read_hosts(file);
  assert_string_equal(joined(hosts.list), "cell7 203.0.113.7");
  assert_true(hosts.damages.empty());
  assert_true(write_hosts(file, {}).is_ok());
  hosts = *read_hosts(file);
  assert_true(hosts.list.empty() && hosts.damages.empty());
}

void no_file_declares_none(void**) {
  hosts = *read_hosts(file);
  assert_true(hosts.list.empty() && hosts.damages.empty());
  assert_false(static_cast<bool>(read_hosts(folder)));
}

void a_change_is_told_once_it_is_whole(void**) {
  watch.emplace(file);
  assert_true(watch->read()->empty());
  assert_string_equal(told(), "as before");
  write("cell7\n");
  now += FileWatch::interval;
  assert_false(watch->update(now).has_value());  // an editor may be halfway through it
  now += FileWatch::interval;
  assert_string_equal(joined(*watch->update(now)), "cell7");
  assert_string_equal(told(), "as before");
  write("cell7\n?\ncell8\n");
  assert_string_equal(told(), "cell7 cell8");
  std::filesystem::remove(file);
  assert_string_equal(told(), "");
}

void what_cannot_be_read_changes_nothing(void**) {
  write("cell7\n");
  watch.emplace(file);
  assert_string_equal(joined(*watch->read()), "cell7");
  std::filesystem::remove(file);
  std::filesystem::create_directory(file);
  assert_string_equal(told(), "as before");
  assert_false(watch->read().has_value());
}

void without_a_file_there_is_nothing_to_look_at(void**) {
  watch.emplace();
  assert_true(watch->read()->empty());
  assert_string_equal(told(), "as before");
}

}  // namespace
}  // namespace flexrf::panel::host_file_test

int main() {
  using namespace flexrf::panel::host_file_test;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_line_is_a_host),
      cmocka_unit_test(a_damaged_line_is_told_and_the_others_count),
      cmocka_unit_test(there_are_eight_at_most),
      cmocka_unit_test(a_list_is_separated_by_blanks),
      cmocka_unit_test_setup_teardown(what_is_written_is_read, begin, end),
      cmocka_unit_test_setup_teardown(no_file_declares_none, begin, end),
      cmocka_unit_test_setup_teardown(a_change_is_told_once_it_is_whole, begin, end),
      cmocka_unit_test_setup_teardown(what_cannot_be_read_changes_nothing, begin, end),
      cmocka_unit_test_setup_teardown(without_a_file_there_is_nothing_to_look_at, begin, end),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
