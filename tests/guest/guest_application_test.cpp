// An application as it is built, on a PREEMPT_RT kernel with the right to be real-time: it gets its priority,
// takes keys from a pipe, and ends by itself when they end.
#include <dirent.h>
#include <sched.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <thread>

#include "places.hpp"
#include "tests/cmocka.hpp"

namespace {

constexpr int control_priority = 40;  // apps/keyboard/keyboard.toml
constexpr auto limit = std::chrono::seconds(90);

pid_t application = -1;

void after(std::chrono::steady_clock::time_point deadline, const char* what) {
  if (std::chrono::steady_clock::now() < deadline) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    return;
  }
  ::kill(application, SIGKILL);
  fail_msg("%s within %d s", what, static_cast<int>(limit.count()));
}

bool has_control_thread() {
  char path[48];
  std::snprintf(path, sizeof path, "/proc/%d/task", static_cast<int>(application));
  DIR* const threads = ::opendir(path);
  if (threads == nullptr) return false;
  bool found = false;
  while (const dirent* entry = ::readdir(threads)) {
    const int thread = std::atoi(entry->d_name);
    sched_param priority{};
    if (thread == 0 || ::sched_getparam(thread, &priority) != 0) continue;
    const int policy = ::sched_getscheduler(thread) & ~SCHED_RESET_ON_FORK;
    found = found || (policy == SCHED_FIFO && priority.sched_priority == control_priority);
  }
  ::closedir(threads);
  return found;
}

void keyboard_runs_real_time_until_its_keys_end(void**) {
  int keys[2];
  assert_int_equal(::pipe(keys), 0);
  application = ::fork();
  assert_true(application >= 0);
  if (application == 0) {
    ::dup2(keys[0], STDIN_FILENO);
    ::close(keys[0]);
    ::close(keys[1]);
    ::execl(place::keyboard, place::keyboard, static_cast<char*>(nullptr));
    ::_exit(127);
  }
  ::close(keys[0]);
  assert_int_equal(::write(keys[1], "wwwwddd", 7), 7);
  const auto deadline = std::chrono::steady_clock::now() + limit;
  while (!has_control_thread()) after(deadline, "no thread with SCHED_FIFO 40");
  ::close(keys[1]);
  int status = 0;
  while (::waitpid(application, &status, WNOHANG) == 0) after(deadline, "the application did not end");
  assert_true(WIFEXITED(status));
  assert_int_equal(WEXITSTATUS(status), 0);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(keyboard_runs_real_time_until_its_keys_end)};
  return cmocka_run_group_tests_name("an application in the guest", tests, nullptr, nullptr);
}
