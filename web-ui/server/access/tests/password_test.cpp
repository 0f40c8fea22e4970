#include "web-ui/server/access/password.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
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
  std::fprintf(
      file,
      "#!/bin/sh\n"
      "{ echo argument $1; echo descriptors $(ls /proc/$$/fd | grep -c '^[3-9]$');"
      " grep -E '^(SigBlk|SigIgn|VmLck)' /proc/$$/status; env | grep -c FLEXRF_SECRET; } > %s\nexit 42\n",
      seen.c_str());
  std::fclose(file);
  assert_int_equal(chmod(script.c_str(), 0700), 0);
  const int leaked = open("/dev/null", O_RDONLY);  // without O_CLOEXEC
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
                      "descriptors 0\n"
                      "VmLck:\t       0 kB\n"
                      "SigBlk:\t0000000000000000\n"
                      "SigIgn:\t0000000000000000\n"
                      "0\n");
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
      cmocka_unit_test(another_start_is_an_ordinary_one),
  };
  return cmocka_run_group_tests(tests, begin_group, nullptr);
}
