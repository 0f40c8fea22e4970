#include "web-ui/server/access/password.hpp"

#include <poll.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>

#include "tests/cmocka.hpp"
#include "web-ui/server/access/panel_access.hpp"
#include "web-ui/server/access/password_check.hpp"
#include "web-ui/server/access/password_helper.hpp"

namespace flexrf::panel {
namespace {

using Outcome = PasswordCheck::Outcome;

constexpr const char* password = "a long \xC3\xA4nd winding pass: word";
std::string hash;
std::optional<PasswordCheck> check;
constexpr Time now{std::chrono::seconds{1000}};

int begin_group(void**) {
  if (!prepare_cryptography()) return -1;
  Result<std::string> made = hash_password(password);
  hash = made ? *made : "";
  return hash.empty() ? -1 : 0;
}

int begin(void**) {
  check.emplace();
  return 0;
}

int end(void**) {
  check.reset();
  return 0;
}

Outcome wait_for_outcome() {
  while (check->is_busy()) {
    const Outcome outcome = check->update(now);
    if (outcome != Outcome::none) return outcome;
    poll(nullptr, 0, 5);
  }
  return Outcome::none;
}

void a_hash_tells_right_from_wrong(void**) {
  assert_true(is_password_hash(hash));
  assert_true(is_right_password(hash, password));
  assert_false(is_right_password(hash, "a long and winding pass: word"));
  assert_false(is_right_password(hash, ""));
  assert_false(is_right_password("", password));
}

void passwords_have_a_length(void**) {
  assert_true(check_password(password).is_ok());
  assert_false(check_password("1234567").is_ok());
  assert_true(check_password(std::string(longest_password, 'x')).is_ok());
  assert_false(check_password(std::string(longest_password + 1, 'x')).is_ok());
  assert_false(check_password("1234567\t89").is_ok());
}

void damaged_hashes_are_no_hashes(void**) {
  static std::string text;
  for (std::size_t size = 0; size < hash.size(); ++size) assert_false(is_password_hash(hash.substr(0, size)));
  for (const char* other : {"$argon2i$v=19$m=65536,t=2,p=1$", "$argon2id$v=16$m=65536,t=2,p=1$",
                            "$argon2id$v=19$m=65537,t=2,p=1$", "$argon2id$v=19$m=65536,t=3,p=1$",
                            "$argon2id$v=19$m=-1,t=2,p=1$", "$argon2id$v=19$m=65536,t=2,p=2$"}) {
    text = other + std::string(22, 'A') + "$" + std::string(43, 'A');
    assert_false(is_password_hash(text));
  }
}

void another_process_tells_right_from_wrong(void**) {
  assert_true(check->start(hash, password, now).is_ok());
  assert_true(check->is_busy());
  assert_int_equal(check->start(hash, password, now).code(), StatusCode::busy);
  assert_int_equal(wait_for_outcome(), Outcome::right);
  assert_false(check->is_busy());
  assert_int_equal(check->update(now), Outcome::none);
  for (const char* wrong :
       {"", "x", "a long \xC3\xA4nd winding pass: wore", "a long \xC3\xA4nd winding pass: word\n"}) {
    assert_true(check->start(hash, wrong, now).is_ok());
    assert_int_equal(wait_for_outcome(), Outcome::wrong);
  }
}

void the_longest_password_passes(void**) {
  static std::string longest(longest_password, '\xFF');
  static std::string its_hash;
  its_hash = *hash_password(longest);
  assert_true(check->start(its_hash, longest, now).is_ok());
  assert_int_equal(wait_for_outcome(), Outcome::right);
  longest += 'x';
  assert_int_equal(check->start(its_hash, longest, now).code(), StatusCode::invalid_argument);
}

void what_is_no_hash_cannot_be_told(void**) {
  assert_true(check->start("secret", "secret", now).is_ok());
  assert_int_equal(wait_for_outcome(), Outcome::failed);
}

void an_executable_that_is_not_there_or_not_ours(void**) {
  check.emplace("/nowhere");
  assert_int_equal(check->start(hash, password, now).code(), StatusCode::unavailable);
  assert_false(check->is_busy());
  // Ends with 0, which is nobody's consent.
  check.emplace("/bin/true");
  assert_true(check->start(hash, password, now).is_ok());
  assert_int_equal(wait_for_outcome(), Outcome::failed);
}

void one_that_takes_too_long_is_ended(void**) {
  char script[] = "/tmp/flexrf-slow-XXXXXX";
  const int file = mkstemp(script);
  const char text[] = "#!/bin/sh\nexec sleep 1000\n";
  assert_int_equal(write(file, text, sizeof(text) - 1), sizeof(text) - 1);
  assert_int_equal(fchmod(file, 0700), 0);
  close(file);
  check.emplace(script);
  assert_true(check->start(hash, password, now).is_ok());
  assert_int_equal(check->update(now + PasswordCheck::time_limit - std::chrono::milliseconds{1}),
                   Outcome::none);
  Outcome outcome = Outcome::none;
  while (outcome == Outcome::none) {
    outcome = check->update(now + PasswordCheck::time_limit);
    poll(nullptr, 0, 5);
  }
  unlink(script);
  assert_int_equal(outcome, Outcome::failed);
}

constexpr int leaked = 9;

/// A script in the helper's place writes down what it finds of itself.
void nothing_is_inherited(void**) {
  char folder[] = "/tmp/flexrf-inherit-XXXXXX";
  assert_non_null(mkdtemp(folder));
  static std::string script;
  static std::string seen;
  script = std::string{folder} + "/script";
  seen = std::string{folder} + "/seen";
  std::FILE* const file = std::fopen(script.c_str(), "w");
  assert_non_null(file);
  std::fprintf(file,
               "#!/bin/sh\n"
               "status() { sed -n \"s/^$1:[[:space:]]*//p\" /proc/$$/status; }\n"
               "{ echo argument $1; [ -e /proc/$$/fd/%d ] && echo leaked; echo locked $(status VmLck);"
               " echo blocked $(status SigBlk); echo ignored $((0x$(status SigIgn) & 0x7fffffff));"
               " env | grep FLEXRF_SECRET; } > %s\nexit 42\n",
               leaked, seen.c_str());
  std::fclose(file);
  assert_int_equal(chmod(script.c_str(), 0700), 0);
  assert_int_equal(dup2(STDIN_FILENO, leaked), leaked);  // without O_CLOEXEC
  assert_int_equal(setenv("FLEXRF_SECRET", "1", 1), 0);
  std::signal(SIGPIPE, SIG_IGN);
  check.emplace(script);
  assert_true(check->start(hash, password, now).is_ok());
  assert_int_equal(wait_for_outcome(), Outcome::right);
  close(leaked);
  static char text[1000];
  std::FILE* const answer = std::fopen(seen.c_str(), "r");
  assert_non_null(answer);
  text[std::fread(text, 1, sizeof(text) - 1, answer)] = '\0';
  std::fclose(answer);
  unlink(script.c_str());
  unlink(seen.c_str());
  rmdir(folder);
  assert_string_equal(text,
                      "argument --panel-verify-password\n"
                      "locked 0 kB\n"
                      "blocked 0000000000000000\n"
                      "ignored 0\n");
}

/// The value of a field of /proc/PID/status; empty: there is none.
std::string status_of(pid_t process, const char* field) {
  std::FILE* const file = std::fopen(("/proc/" + std::to_string(process) + "/status").c_str(), "r");
  if (file == nullptr) return "";
  char line[256];
  std::string value;
  const std::string wanted = std::string{field} + ":\t";
  while (value.empty() && std::fgets(line, sizeof(line), file) != nullptr) {
    if (std::string_view{line}.starts_with(wanted)) value = line + wanted.size();
  }
  std::fclose(file);
  return value;
}

void the_helper_has_no_rights(void**) {
  int input[2];
  assert_int_equal(pipe(input), 0);
  const pid_t helper = fork();
  if (helper == 0) {
    dup2(input[0], STDIN_FILENO);
    close(input[1]);
    execl("/proc/self/exe", "helper", password_helper_argument, nullptr);
    _exit(127);
  }
  assert_true(helper > 0);
  // It waits for its input once it has given up everything; no_new_privs is what it gives up last but limits.
  static std::string state;
  for (state = "R"; status_of(helper, "NoNewPrivs") != "1\n" || state[0] != 'S';
       state = status_of(helper, "State")) {
    assert_false(state.starts_with('Z'));
    poll(nullptr, 0, 2);
  }
  static std::string user;
  static std::string group;
  static std::string capabilities;
  static std::string name;
  user = status_of(helper, "Uid");
  group = status_of(helper, "Gid");
  capabilities = status_of(helper, "CapEff") + status_of(helper, "CapPrm");
  name = status_of(helper, "Name");
  close(input[0]);
  close(input[1]);
  int status = 0;
  assert_int_equal(waitpid(helper, &status, 0), helper);
  assert_int_equal(WEXITSTATUS(status), 1);  // it got nothing to check
  assert_string_equal(name.c_str(), "password-check\n");
  assert_string_equal(capabilities.c_str(), "0000000000000000\n0000000000000000\n");
  if (geteuid() != 0) return;
  assert_string_equal(user.c_str(), "65534\t65534\t65534\t65534\n");
  assert_string_equal(group.c_str(), "65534\t65534\t65534\t65534\n");
}

void another_start_is_an_ordinary_one(void**) {
  char name[] = "cell";
  char help[] = "--help";
  char verify[] = "--panel-verify-password";
  char* one[] = {name, nullptr};
  char* two[] = {name, help, nullptr};
  char* three[] = {name, help, verify, nullptr};
  assert_false(run_password_helper(1, one).has_value());
  assert_false(run_password_helper(2, two).has_value());
  assert_false(run_password_helper(3, three).has_value());
}

}  // namespace
}  // namespace flexrf::panel

int main(int argument_count, char** arguments) {
  using namespace flexrf::panel;
  if (const auto code = run_password_helper(argument_count, arguments)) return *code;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_hash_tells_right_from_wrong),
      cmocka_unit_test(passwords_have_a_length),
      cmocka_unit_test(damaged_hashes_are_no_hashes),
      cmocka_unit_test_setup_teardown(another_process_tells_right_from_wrong, begin, end),
      cmocka_unit_test_setup_teardown(the_longest_password_passes, begin, end),
      cmocka_unit_test_setup_teardown(what_is_no_hash_cannot_be_told, begin, end),
      cmocka_unit_test_setup_teardown(an_executable_that_is_not_there_or_not_ours, begin, end),
      cmocka_unit_test_setup_teardown(one_that_takes_too_long_is_ended, begin, end),
      cmocka_unit_test_setup_teardown(nothing_is_inherited, begin, end),
      cmocka_unit_test(the_helper_has_no_rights),
      cmocka_unit_test(another_start_is_an_ordinary_one),
  };
  return cmocka_run_group_tests(tests, begin_group, nullptr);
}
