// flexrf-password as people and scripts use it.
#include <poll.h>
#include <pty.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>

#include "places.hpp"
#include "tests/cmocka.hpp"
#include "web-ui/server/access/panel_access.hpp"
#include "web-ui/server/access/password.hpp"
#include "web-ui/server/access/user_file.hpp"

namespace flexrf::panel {
namespace {

std::string folder;
std::string file;
std::string output;

int begin(void**) {
  if (!prepare_cryptography()) return -1;
  char name[] = "/tmp/flexrf-password-XXXXXX";
  if (mkdtemp(name) == nullptr) return -1;
  folder = name;
  file = folder + "/panel-users";
  return 0;
}

int end(void**) {
  std::filesystem::remove_all(folder);
  return 0;
}

/// The exit code; what it printed, on either, is in `output`.
int run(const char* input, const std::string& arguments) {
  const std::string command = std::string{"printf '"} + input + "' | " + place::password_tool + " " +
                              arguments + " " + file + " 2>&1";
  std::FILE* const pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return -1;
  output.clear();
  for (int character = std::getc(pipe); character != EOF; character = std::getc(pipe))
    output += static_cast<char>(character);
  const int status = pclose(pipe);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

bool has(const char* text) {
  return output.find(text) != std::string::npos;
}

/// Whether this is what the file says of a user.
bool is_in_file(const char* name, Role role, const char* password) {
  const Result<Users> users = read_users(file);
  const User* const user = users ? users->find(name) : nullptr;
  return user != nullptr && user->role == role && is_right_password(user->password_hash, password);
}

void a_first_user_is_an_admin(void**) {
  assert_int_equal(run("first secret\\n", ""), 0);
  assert_true(has("admin may log in as admin, at once where"));
  assert_true(is_in_file("admin", Role::admin, "first secret"));
  struct stat status {};
  assert_int_equal(stat(file.c_str(), &status), 0);
  assert_int_equal(status.st_mode & 0777, 0600);
}

void users_are_added_changed_listed_and_removed(void**) {
  assert_int_equal(run("first secret\\n", ""), 0);
  assert_int_equal(run("second secret", "--user ann --role operator"), 0);
  assert_int_equal(run("third secret\\n", "--user ann"), 0);  // the role stays
  assert_true(is_in_file("ann", Role::operator_, "third secret"));
  assert_true(is_in_file("admin", Role::admin, "first secret"));
  assert_int_equal(run("", "--list"), 0);
  assert_string_equal(output.c_str(),
                      "admin                           admin\nann                             operator\n");
  assert_int_equal(run("", "--remove admin"), 0);
  assert_int_equal(run("", "--list"), 0);
  assert_string_equal(output.c_str(), "ann                             operator\n");
  assert_int_equal(run("", "--remove admin"), 1);
  assert_true(has("there is no user 'admin'"));
}

void what_is_wrong_changes_nothing(void**) {
  assert_int_equal(run("eleven char\\n", ""), 1);
  assert_true(has("at least 12 characters"));
  assert_int_equal(run("", ""), 1);
  assert_true(has("no password came on standard input"));
  assert_int_equal(run("good enough now\\n", "--role boss"), 1);
  assert_true(has("unknown role 'boss'"));
  assert_int_equal(run("good enough now\\n", "--user 'a b'"), 1);
  assert_int_equal(run("good enough now\\n", "--usr ann"), 1);
  assert_true(has("unexpected '--usr'") && has("Exit code:"));
  assert_int_equal(run("good enough now\\n", "--list"), 1);
  assert_false(std::filesystem::exists(file));
}

void a_damaged_file_is_not_written_over(void**) {
  std::FILE* const damaged = std::fopen(file.c_str(), "w");
  std::fputs("ann:boss:x\n", damaged);
  std::fclose(damaged);
  assert_int_equal(run("good enough now\\n", ""), 1);
  assert_true(has("others may read it: chmod 600"));
  assert_int_equal(chmod(file.c_str(), 0600), 0);
  assert_int_equal(run("good enough now\\n", ""), 1);
  assert_true(has("panel-users:1: unknown role 'boss'"));
  assert_int_equal(std::filesystem::file_size(file), 11);
}

/// Answers the questions on a terminal; each answer after its question. The exit code.
int run_on_terminal(std::initializer_list<const char*> answers) {
  int terminal = -1;
  const pid_t child = forkpty(&terminal, nullptr, nullptr, nullptr);
  if (child == 0) {
    execl(place::password_tool, "flexrf-password", file.c_str(), nullptr);
    _exit(127);
  }
  if (child < 0) return -1;
  output.clear();
  auto answer = answers.begin();
  std::size_t asked = 0;
  char part[256];
  for (ssize_t count = 0; (count = read(terminal, part, sizeof(part))) > 0;) {
    output.append(part, static_cast<std::size_t>(count));
    if (answer == answers.end() || output.find(": ", asked) == std::string::npos) continue;
    asked = output.size();
    if (write(terminal, *answer, std::strlen(*answer)) < 0) break;
    ++answer;
  }
  int status = 0;
  waitpid(child, &status, 0);
  close(terminal);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

void a_terminal_does_not_show_the_password(void**) {
  assert_int_equal(run_on_terminal({"typed secret\n", "typed secret\n"}), 0);
  assert_true(has("New password for admin: ") && has("Once more"));
  assert_false(has("secret"));
  assert_true(is_in_file("admin", Role::admin, "typed secret"));
}

void both_have_to_be_the_same(void**) {
  assert_int_equal(run_on_terminal({"typed secret\n", "typed secrte\n"}), 1);
  assert_true(has("the two passwords differ"));
  assert_false(std::filesystem::exists(file));
}

void control_c_gives_up(void**) {
  assert_int_equal(run_on_terminal({"typed\x03"}), 1);
  assert_true(has("no password was given"));
  assert_false(std::filesystem::exists(file));
}

}  // namespace
}  // namespace flexrf::panel

int main() {
  using namespace flexrf::panel;
  const CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(a_first_user_is_an_admin, begin, end),
      cmocka_unit_test_setup_teardown(users_are_added_changed_listed_and_removed, begin, end),
      cmocka_unit_test_setup_teardown(what_is_wrong_changes_nothing, begin, end),
      cmocka_unit_test_setup_teardown(a_damaged_file_is_not_written_over, begin, end),
      cmocka_unit_test_setup_teardown(a_terminal_does_not_show_the_password, begin, end),
      cmocka_unit_test_setup_teardown(both_have_to_be_the_same, begin, end),
      cmocka_unit_test_setup_teardown(control_c_gives_up, begin, end),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
