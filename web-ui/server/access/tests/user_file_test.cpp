#include "web-ui/server/access/user_file.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "tests/cmocka.hpp"
#include "web-ui/server/access/start_rules.hpp"

namespace flexrf::panel::user_file_test {
namespace {

#define HASH \
  "$argon2id$v=19$m=65536,t=2,p=1$AAAAAAAAAAAAAAAAAAAAAA$AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA"

std::string folder;
std::string file;
Users users;
std::string cause;

int begin(void**) {
  char name[] = "/tmp/flexrf-users-XXXXXX";
  if (mkdtemp(name) == nullptr) return -1;
  folder = name;
  file = folder + "/panel-users";
  users = {};
  return 0;
}

int end(void**) {
  std::filesystem::remove_all(folder);
  return 0;
}

/// The cause of the refusal, or "".
const char* refusal(const char* text) {
  cause = parse_users(text, "F").status().cause();
  return cause.c_str();
}

void what_is_written_is_read(void**) {
  users.list = {{"ann", Role::operator_, HASH}, {"B.o-b_2", Role::admin, HASH}};
  assert_true(write_users(file, users).is_ok());
  struct stat status {};
  assert_int_equal(stat(file.c_str(), &status), 0);
  assert_int_equal(status.st_mode & 0777, 0600);
  static Result<Users> read = Users{};
  read = read_users(file);
  assert_true(static_cast<bool>(read));
  assert_int_equal(read->list.size(), 2);
  assert_non_null(read->find("ann"));
  assert_int_equal(read->find("ann")->role, Role::operator_);
  assert_string_equal(read->find("B.o-b_2")->password_hash.c_str(), HASH);
  assert_null(read->find("nobody"));
}

void comments_and_empty_lines_are_left_out(void**) {
  assert_string_equal(refusal("# x\n\n#y:z\nann:viewer:" HASH "\r\nbob:admin:" HASH), "");
  assert_int_equal(parse_users("", "F")->list.size(), 0);
}

void damaged_lines_are_named(void**) {
  const char* const hint = " (a line is name:role:password; `./flexrf password` writes it)";
  static std::string expected;
  const auto expect = [&](const char* text, const char* what) {
    expected = std::string{"F:2: "} + what + hint;
    static std::string whole;
    whole = std::string{"# comment\n"} + text + "\n";
    assert_string_equal(refusal(whole.c_str()), expected.c_str());
  };
  expect("ann", "two colons are expected");
  expect("ann:viewer", "two colons are expected");
  expect("ann:viewer:", "the password is damaged or of a foreign kind");
  expect("ann:viewer:secret", "the password is damaged or of a foreign kind");
  expect("ann:viewer:" HASH "x", "the password is damaged or of a foreign kind");
  expect(
      "ann:viewer:$argon2id$v=19$m=1048576,t=2,p=1$AAAAAAAAAAAAAAAAAAAAAA$"
      "AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA",
      "the password is damaged or of a foreign kind");
  expect("ann:viewr:" HASH,
         "unknown role 'viewr', did you mean 'viewer'?: viewer, operator, engineer or admin");
  expect(":viewer:" HASH, "'' cannot be a user's name: 1 to 31 letters, digits, dots, dashes, underscores");
}

void nobody_has_two_lines(void**) {
  assert_non_null(
      strstr(refusal("ann:viewer:" HASH "\nann:admin:" HASH "\n"), "F:2: this user has a line already"));
}

void others_must_not_read_it(void**) {
  assert_true(write_users(file, users).is_ok());
  assert_int_equal(chmod(file.c_str(), 0640), 0);
  static Status status;
  status = read_users(file).status();
  assert_int_equal(status.code(), StatusCode::not_permitted);
  assert_non_null(strstr(status.cause(), "chmod 600"));
}

void a_start_needs_a_user(void**) {
  assert_int_equal(users_to_start_with(file).status().code(), StatusCode::not_found);
  assert_true(write_users(file, users).is_ok());
  assert_int_equal(users_to_start_with(file).status().code(), StatusCode::invalid_argument);
  users.list = {{"ann", Role::viewer, HASH}};
  assert_true(write_users(file, users).is_ok());
  assert_true(static_cast<bool>(users_to_start_with(file)));
}

void other_machines_need_passwords_and_tls(void**) {
  const auto is_allowed = [](const char* address, bool has_users, bool secure, bool insecure) {
    return check_exposure({*Address::parse(address), has_users, secure, insecure}).is_ok();
  };
  assert_true(is_allowed("127.0.0.1", false, false, false));
  assert_true(is_allowed("::1", false, false, false));
  for (const char* address : {"0.0.0.0", "::", "10.0.0.1", "fe80::1"}) {
    assert_false(is_allowed(address, false, false, false));
    assert_false(is_allowed(address, false, true, false));
    assert_false(is_allowed(address, false, false, true));
    assert_false(is_allowed(address, true, false, false));
    assert_true(is_allowed(address, true, true, false));
    assert_true(is_allowed(address, true, false, true));
  }
}

}  // namespace
}  // namespace flexrf::panel::user_file_test

int main() {
  using namespace flexrf::panel::user_file_test;
  const CMUnitTest tests[] = {
      cmocka_unit_test_setup_teardown(what_is_written_is_read, begin, end),
      cmocka_unit_test(comments_and_empty_lines_are_left_out),
      cmocka_unit_test(damaged_lines_are_named),
      cmocka_unit_test(nobody_has_two_lines),
      cmocka_unit_test_setup_teardown(others_must_not_read_it, begin, end),
      cmocka_unit_test_setup_teardown(a_start_needs_a_user, begin, end),
      cmocka_unit_test(other_machines_need_passwords_and_tls),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
