#include "runtime/realtime/rights.hpp"

#include <grp.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "runtime/realtime/process_statistics.hpp"
#include "tests/cmocka.hpp"

namespace flexrf::rights_test {
namespace {

struct Answer {
  RightsReport report;
  Status status;
};

/// What a process without any right learns: another user than root, both limits set. False when the process
/// could not be made one.
bool ask_without_rights(const RightsNeeded& needed, rlim_t priority, rlim_t locked, Answer& answer) {
  int ends[2];
  if (pipe(ends) != 0) return false;
  const pid_t child = fork();
  if (child == 0) {
    const rlimit priority_limit{priority, priority};
    const rlimit lock_limit{locked, locked};
    bool good = setrlimit(RLIMIT_RTPRIO, &priority_limit) == 0 && setrlimit(RLIMIT_MEMLOCK, &lock_limit) == 0;
    if (geteuid() == 0) good = good && setgroups(0, nullptr) == 0 && setgid(65534) == 0 && setuid(65534) == 0;
    if (good) {
      Answer mine{probe_rights(needed), {}};
      mine.status = mine.report.status();
      good = write(ends[1], &mine, sizeof(mine)) == sizeof(mine);
    }
    _exit(good ? 0 : 1);
  }
  close(ends[1]);
  const ssize_t size = read(ends[0], &answer, sizeof(answer));
  close(ends[0]);
  int result = 0;
  waitpid(child, &result, 0);
  return size == static_cast<ssize_t>(sizeof(answer)) && result == 0;
}

/// The message promised, for whoever the test runs as.
void expect_text(const RightsReport& report, const char* format) {
  char executable[256];
  const ssize_t length = readlink("/proc/self/exe", executable, sizeof(executable) - 1);
  executable[length] = '\0';
  char expected[2048];
  const char* const user = geteuid() == 0 ? "nobody" : getenv("USER");
  std::size_t used = 0;
  for (const char* at = format; *at != '\0'; ++at) {
    const char* const part = *at == '@' && at[1] == 'U' ? user : *at == '@' && at[1] == 'E' ? executable : "";
    if (*part != '\0') {
      used += static_cast<std::size_t>(std::snprintf(expected + used, sizeof(expected) - used, "%s", part));
      ++at;
    } else {
      expected[used++] = *at;
    }
  }
  expected[used] = '\0';
  assert_string_equal(report.text, expected);
}

void nothing_needed_is_complete(void**) {
  const RightsReport report = probe_rights({});
  assert_true(report.is_complete());
  assert_true(report.status().is_ok());
  assert_string_equal(report.text, "");
}

void both_rights_missing(void**) {
  static Answer answer;
  assert_true(ask_without_rights({40, 64 << 20}, 0, 8192 << 10, answer));
  assert_true(answer.report.priority_missing);
  assert_true(answer.report.lock_missing);
  assert_int_equal(answer.status.code(), StatusCode::not_permitted);
  assert_string_equal(answer.status.cause(),
                      "missing right: SCHED_FIFO priority 40 (RLIMIT_RTPRIO 0, no CAP_SYS_NICE), 65536 KiB "
                      "of locked memory (RLIMIT_MEMLOCK 8192 KiB, no CAP_IPC_LOCK)");
  expect_text(answer.report,
              "Missing right: real-time priority 40 (SCHED_FIFO) for user @U.\n"
              "  RLIMIT_RTPRIO is 0 and the process does not hold CAP_SYS_NICE.\n"
              "Missing right: 65536 KiB of locked memory for user @U.\n"
              "  RLIMIT_MEMLOCK is 8192 KiB and the process does not hold CAP_IPC_LOCK.\n"
              "Grant it in one of these ways, as root:\n"
              "  - by limits:\n"
              "      groupadd --force flexrf\n"
              "      usermod --append --groups flexrf @U\n"
              "    and into /etc/security/limits.d/90-flexrf.conf, in force after the next login:\n"
              "      @flexrf - rtprio 49\n"
              "      @flexrf - memlock unlimited\n"
              "  - by capabilities of the executable:\n"
              "      setcap cap_sys_nice,cap_ipc_lock=ep @E\n"
              "  - by systemd, in the [Service] section of its unit:\n"
              "      LimitRTPRIO=49\n"
              "      LimitMEMLOCK=infinity\n");
}

void one_right_missing(void**) {
  static Answer answer;
  assert_true(ask_without_rights({60, 4096}, 0, 8192 << 10, answer));
  assert_true(answer.report.priority_missing);
  assert_false(answer.report.lock_missing);
  expect_text(answer.report,
              "Missing right: real-time priority 60 (SCHED_FIFO) for user @U.\n"
              "  RLIMIT_RTPRIO is 0 and the process does not hold CAP_SYS_NICE.\n"
              "Grant it in one of these ways, as root:\n"
              "  - by limits:\n"
              "      groupadd --force flexrf\n"
              "      usermod --append --groups flexrf @U\n"
              "    and into /etc/security/limits.d/90-flexrf.conf, in force after the next login:\n"
              "      @flexrf - rtprio 60\n"
              "  - by capabilities of the executable:\n"
              "      setcap cap_sys_nice=ep @E\n"
              "  - by systemd, in the [Service] section of its unit:\n"
              "      LimitRTPRIO=60\n");
  assert_true(ask_without_rights({0, 9 << 20}, 0, 8192 << 10, answer));
  assert_false(answer.report.priority_missing);
  assert_true(answer.report.lock_missing);
  assert_null(strstr(answer.report.text, "rtprio"));
  assert_non_null(strstr(answer.report.text, "setcap cap_ipc_lock=ep "));
}

void a_limit_that_suffices_is_enough(void**) {
  rlimit limit{};
  getrlimit(RLIMIT_RTPRIO, &limit);
  const rlimit raised{40, 40};
  // Needs CAP_SYS_RESOURCE, which not even root has everywhere.
  if (limit.rlim_max < 40 && setrlimit(RLIMIT_RTPRIO, &raised) != 0) skip();
  static Answer answer;
  assert_true(ask_without_rights({40, 1 << 20}, 40, 8192 << 10, answer));
  assert_true(answer.report.is_complete());
  assert_true(answer.status.is_ok());
  assert_true(ask_without_rights({41, 1 << 20}, 40, 8192 << 10, answer));
  assert_true(answer.report.priority_missing);
}

bool has_little_to_lock() {
  const rlimit limit{65536, 65536};
  return setrlimit(RLIMIT_MEMLOCK, &limit) == 0 && (geteuid() != 0 || setuid(65534) == 0);
}

/// As a service's or a container's filter does that does not know it.
bool is_refused_mincore() {
  sock_filter program[] = {BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
                           BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_mincore, 0, 1),
                           BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | EPERM),
                           BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW)};
  const sock_fprog filter{4, program};
  return prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
         prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &filter) == 0;
}

bool is_as_it_was() {
  return true;
}

/// Locks all memory in a process of its own, for a test's memory is not to stay locked.
int lock_in_child(bool (*becomes)()) {
  const pid_t child = fork();
  if (child == 0) {
    if (!becomes()) _exit(11);
    const Status status = lock_all_memory();
    if (status && read_process_statistics()->locked == 0) _exit(12);
    _exit(status ? 0 : static_cast<int>(status.code()));
  }
  int result = 0;
  waitpid(child, &result, 0);
  return WIFEXITED(result) ? WEXITSTATUS(result) : -1;
}

void memory_is_locked_or_refused(void**) {
#if FLEXRF_SANITIZER
  skip();  // sanitizers do not lock memory
#endif
  assert_int_equal(lock_in_child(has_little_to_lock), StatusCode::not_permitted);
  if (geteuid() != 0) return;
  assert_int_equal(lock_in_child(is_as_it_was), 0);
  assert_int_equal(lock_in_child(is_refused_mincore), StatusCode::not_permitted);
}

}  // namespace
}  // namespace flexrf::rights_test

int main() {
  using namespace flexrf::rights_test;
  const CMUnitTest tests[] = {
      cmocka_unit_test(nothing_needed_is_complete),  cmocka_unit_test(both_rights_missing),
      cmocka_unit_test(one_right_missing),           cmocka_unit_test(a_limit_that_suffices_is_enough),
      cmocka_unit_test(memory_is_locked_or_refused),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
