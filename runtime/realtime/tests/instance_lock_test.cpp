#include "runtime/realtime/instance_lock.hpp"

#include <sched.h>
#include <sys/mount.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "tests/cmocka.hpp"

namespace flexrf::instance_lock_test {
namespace {

char directory[64];

int make_directory(void**) {
  std::snprintf(directory, sizeof(directory), "/tmp/flexrf-lock-XXXXXX");
  return mkdtemp(directory) == nullptr ? 1 : chmod(directory, 0755);
}

int remove_directory(void**) {
  char path[128];
  for (const char* const cell : {"one", "two"}) {
    std::snprintf(path, sizeof(path), "%s/flexrf-%s.lock", directory, cell);
    unlink(path);
  }
  return rmdir(directory);
}

// [stop-66]
void one_holder_per_cell(void**) {
  static InstanceLock first;
  static InstanceLock second;
  static InstanceLock other;
  assert_true(first.acquire("one", directory).is_ok());
  assert_true(other.acquire("two", directory).is_ok());
  const Status status = second.acquire("one", directory);
  assert_int_equal(status.code(), StatusCode::busy);
  assert_false(second.is_held());
  char expected[128];
  std::snprintf(expected, sizeof(expected), "cell one is run already by process %d (", getpid());
  assert_memory_equal(status.cause(), expected, strlen(expected));
  assert_non_null(strstr(status.cause(), "instance_lock_test"));
  assert_non_null(strstr(status.cause(), "), since 2"));
  assert_non_null(strstr(status.cause(), first.path()));
  first.release();
  assert_true(second.acquire("one", directory).is_ok());
  assert_int_equal(second.acquire("one", directory).code(), StatusCode::busy);
  second.release();
  other.release();
}

/// A process that takes the lock and is killed.
bool holder_dies() {
  int ends[2];
  if (pipe(ends) != 0) return false;
  const pid_t child = fork();
  if (child == 0) {
    InstanceLock lock;
    const char good = lock.acquire("one", directory).is_ok() ? 1 : 0;
    if (write(ends[1], &good, 1) != 1) _exit(1);
    pause();
    _exit(0);
  }
  char good = 0;
  const bool told = read(ends[0], &good, 1) == 1 && good == 1;
  InstanceLock lock;
  const bool busy = lock.acquire("one", directory).code() == StatusCode::busy;
  kill(child, SIGKILL);
  int result = 0;
  waitpid(child, &result, 0);
  close(ends[0]);
  close(ends[1]);
  return told && busy && lock.acquire("one", directory).is_ok();
}

// [stop-65]
void a_dead_holder_holds_nothing(void**) {
  assert_true(holder_dies());
}

/// Another user finds the lock taken and who has it, and takes it when it is free.
int other_user_asks() {
  const pid_t child = fork();
  if (child == 0) {
    if (setuid(65534) != 0) _exit(10);
    InstanceLock lock;
    const Status status = lock.acquire("one", directory);
    if (status) _exit(0);
    _exit(status.code() == StatusCode::busy && std::strstr(status.cause(), "by process ") != nullptr ? 1 : 2);
  }
  int result = 0;
  waitpid(child, &result, 0);
  return WIFEXITED(result) ? WEXITSTATUS(result) : -1;
}

void another_user_is_kept_out_too(void**) {
  if (geteuid() != 0) skip();  // nobody else can become another user
  static InstanceLock lock;
  assert_true(lock.acquire("one", directory).is_ok());
  assert_int_equal(other_user_asks(), 1);
  lock.release();
  assert_int_equal(other_user_asks(), 0);
}

void a_directory_that_is_not_there_is_named(void**) {
  static InstanceLock lock;
  const Status status = lock.acquire("one", "/nowhere");
  assert_int_equal(status.code(), StatusCode::unavailable);
  assert_string_equal(status.cause(),
                      "cannot open the lock file /nowhere/flexrf-one.lock: No such file or directory");
}

// ---- where it belongs

// [stop-68]
void a_user_has_a_place_of_its_own(void**) {
  char place[lock_directory_size];
  setenv("XDG_RUNTIME_DIR", directory, 1);
  assert_true(find_lock_directory(LockScope::user, place).is_ok());
  assert_string_equal(place, directory);
  // Where others may write, a lock could have been taken beforehand.
  chmod(directory, 0777);
  assert_true(find_lock_directory(LockScope::user, place).is_ok());
  char own[lock_directory_size];
  std::snprintf(own, sizeof(own), "/tmp/flexrf-%u", geteuid());
  assert_string_equal(place, own);
  chmod(directory, 0755);
  unsetenv("XDG_RUNTIME_DIR");
  assert_true(find_lock_directory(LockScope::user, place).is_ok());
  assert_string_equal(place, own);
}

/// As a user that nobody is, who finds that folder made by somebody else.
int stranger_asks(LockScope scope) {
  const pid_t child = fork();
  if (child == 0) {
    if (setuid(64321) != 0) _exit(10);
    unsetenv("XDG_RUNTIME_DIR");
    char place[lock_directory_size];
    const Status status = find_lock_directory(scope, place);
    if (status) _exit(0);
    const bool told =
        scope == LockScope::user
            ? std::strstr(status.cause(), "/tmp/flexrf-64321") != nullptr
            : std::strstr(status.cause(), "`sudo install -d -m 2775 -g $(id -gn) /run/flexrf`") != nullptr;
    _exit(status.code() == StatusCode::not_permitted && told ? 1 : 2);
  }
  int result = 0;
  waitpid(child, &result, 0);
  return WIFEXITED(result) ? WEXITSTATUS(result) : -1;
}

void somebody_elses_folder_is_not_taken(void**) {
  if (geteuid() != 0) skip();  // nobody else can become another user
  const char* const place = "/tmp/flexrf-64321";
  rmdir(place);
  assert_int_equal(mkdir(place, 0777), 0);
  const int answer = stranger_asks(LockScope::user);
  rmdir(place);
  assert_int_equal(answer, 1);
}

// [stop-67]
void the_machines_place_is_roots_to_make(void**) {
  if (geteuid() != 0) skip();
  char place[lock_directory_size];
  assert_true(find_lock_directory(LockScope::machine, place).is_ok());
  assert_string_equal(place, "/run/flexrf");
  assert_int_equal(stranger_asks(LockScope::machine), 1);
}

/// Where nothing was set up yet, as after a boot.
int makes_the_machines_place() {
  const pid_t child = fork();
  if (child == 0) {
    if (unshare(CLONE_NEWNS) != 0 || mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0 ||
        mount("tmpfs", "/run", "tmpfs", 0, nullptr) != 0)
      _exit(10);
    umask(0);
    char place[lock_directory_size];
    struct stat found {};
    const bool made = find_lock_directory(LockScope::machine, place).is_ok() && stat(place, &found) == 0;
    _exit(made && S_ISDIR(found.st_mode) && (found.st_mode & 07777) == 0755 ? 0 : 1);
  }
  int result = 0;
  waitpid(child, &result, 0);
  return WIFEXITED(result) ? WEXITSTATUS(result) : -1;
}

// [stop-86]
void root_makes_the_machines_place_for_itself_alone(void**) {
  const int answer = makes_the_machines_place();
  if (answer == 10) skip();  // without the rights of root, or where mounting is not for anybody
  assert_int_equal(answer, 0);
}

}  // namespace
}  // namespace flexrf::instance_lock_test

int main() {
  using namespace flexrf::instance_lock_test;
  const CMUnitTest tests[] = {
      cmocka_unit_test(one_holder_per_cell),
      cmocka_unit_test(a_dead_holder_holds_nothing),
      cmocka_unit_test(another_user_is_kept_out_too),
      cmocka_unit_test(a_directory_that_is_not_there_is_named),
      cmocka_unit_test(a_user_has_a_place_of_its_own),
      cmocka_unit_test(somebody_elses_folder_is_not_taken),
      cmocka_unit_test(the_machines_place_is_roots_to_make),
      cmocka_unit_test(root_makes_the_machines_place_for_itself_alone),
  };
  return cmocka_run_group_tests(tests, make_directory, remove_directory);
}
