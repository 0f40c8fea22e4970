// A seccomp filter in each real-time thread that lets through what the thread needs and traps everything
// else. libseccomp writes its program and knows the names; the kernel takes it as it is.

#include "runtime/realtime/system_call_filter.hpp"

#include <linux/filter.h>
#include <linux/seccomp.h>
#include <seccomp.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <memory>
#include <vector>

#include "runtime/realtime/last_gasp.hpp"
#include "runtime/realtime/realtime_scope.hpp"

namespace flexrf {

namespace {

/// What a real-time thread may call, whatever the arguments. Reading, writing and sending wait on a
/// descriptor that blocks, which no filter can see: drivers open theirs so that they do not.
constexpr int harmless_calls[] = {
    // waiting for a release, and waking who waits; locks that libraries hold for a moment
    SCMP_SYS(futex), SCMP_SYS(ppoll), SCMP_SYS(sched_yield), SCMP_SYS(restart_syscall),
    SCMP_SYS(timerfd_settime), SCMP_SYS(epoll_ctl),
    // where the C library cannot read them without asking the kernel
    SCMP_SYS(clock_gettime), SCMP_SYS(clock_getres), SCMP_SYS(gettimeofday), SCMP_SYS(time), SCMP_SYS(getcpu),
    SCMP_SYS(getrusage),
    // IO on what is open
    SCMP_SYS(read), SCMP_SYS(write), SCMP_SYS(readv), SCMP_SYS(writev), SCMP_SYS(recvfrom), SCMP_SYS(sendto),
    SCMP_SYS(recvmsg), SCMP_SYS(sendmsg), SCMP_SYS(recvmmsg), SCMP_SYS(sendmmsg), SCMP_SYS(ioctl),
    // connections that come and go; only sockets that do not block are made here, see below
    SCMP_SYS(connect), SCMP_SYS(setsockopt), SCMP_SYS(getsockopt), SCMP_SYS(shutdown), SCMP_SYS(close),
    // signal handlers, the last gasp among them, and the ends of thread and process
    SCMP_SYS(rt_sigaction), SCMP_SYS(rt_sigprocmask), SCMP_SYS(rt_sigreturn), SCMP_SYS(sigaltstack),
    SCMP_SYS(getpid), SCMP_SYS(gettid), SCMP_SYS(getpgrp), SCMP_SYS(kill), SCMP_SYS(tgkill), SCMP_SYS(exit),
    SCMP_SYS(exit_group)};

/// How long poll() may wait, ms: the last gasp gives a descriptor that much.
constexpr int longest_poll = 10;

struct ArgumentRule {
  int call;
  scmp_arg_cmp argument;
};

const ArgumentRule calls_with_arguments[] = {
    {SCMP_SYS(poll), {2, SCMP_CMP_LE, longest_poll, 0}},
    {SCMP_SYS(socket), {1, SCMP_CMP_MASKED_EQ, SOCK_NONBLOCK, SOCK_NONBLOCK}},
    {SCMP_SYS(accept4), {3, SCMP_CMP_MASKED_EQ, SOCK_NONBLOCK, SOCK_NONBLOCK}},
};

constexpr int call_numbers = 512;
constexpr int sent_by_filter = 1;  // SYS_SECCOMP, which this C library has no name for

/// Made at start and kept: what a thread is filtered with, and names, which libseccomp allocates.
struct Prepared {
  std::vector<sock_filter> program;
  std::array<const char*, call_numbers> names{};
};
constinit const Prepared* prepared = nullptr;
constinit thread_local const char* thread_name [[gnu::tls_model("initial-exec")]] = "?";

/// Text in a buffer of fixed size, as a signal handler may write it.
class Report {
 public:
  Report& operator<<(const char* text) noexcept {
    while (*text != '\0' && size_ + 1 < sizeof(text_)) text_[size_++] = *text++;
    return *this;
  }
  Report& number(std::uintptr_t value, unsigned base) noexcept {
    char digits[24];
    std::size_t place = sizeof(digits);
    digits[--place] = '\0';
    do {
      digits[--place] = "0123456789abcdef"[value % base];
      value /= base;
    } while (value > 0);
    return *this << digits + place;
  }
  const char* text() const noexcept { return text_; }

 private:
  char text_[512] = {};  // ends with a zero
  std::size_t size_ = 0;
};

void trapped(int signal, siginfo_t* information, void* context) noexcept {
  // Somebody sent it: what it does without us.
  if (information->si_code != sent_by_filter) return last_gasp::handle(signal, information, context);
  const int call = information->si_syscall;
  const char* const name =
      call >= 0 && call < call_numbers ? prepared->names[static_cast<std::size_t>(call)] : nullptr;
  const char* const component = last_gasp::stepped();
  Report report;
  report << "\nflexrf: system call " << (name != nullptr ? name : "without a name") << " (";
  report.number(static_cast<std::uintptr_t>(call), 10) << ") at 0x";
  report.number(reinterpret_cast<std::uintptr_t>(information->si_call_addr), 16)
      << " in the real-time thread " << thread_name << ", ";
  if (component != nullptr) {
    report << "in the step of " << component;
  } else {
    report << "between its steps";
  }
  report << ", where nothing may be called that can wait;\nopen, map and start things in initialise(), and "
            "leave what waits to a thread that is not real-time:\n";
  last_gasp::abort_with_trace(report.text());
}

struct ReleaseContext {
  void operator()(void* context) const noexcept { seccomp_release(context); }
};

/// 0, or the error's number.
int make_rules(scmp_filter_ctx context) noexcept {
  for (const int call : harmless_calls)
    if (const int error = seccomp_rule_add_array(context, SCMP_ACT_ALLOW, call, 0, nullptr); error < 0)
      return -error;
  for (const ArgumentRule& rule : calls_with_arguments)
    if (const int error = seccomp_rule_add_array(context, SCMP_ACT_ALLOW, rule.call, 1, &rule.argument);
        error < 0)
      return -error;
  return 0;
}

/// libseccomp gives its program away into a file only.
int write_program(std::vector<sock_filter>& program) {
  const std::unique_ptr<void, ReleaseContext> context(seccomp_init(SCMP_ACT_TRAP));
  if (context == nullptr) return ENOMEM;
  if (const int error = make_rules(context.get()); error != 0) return error;
  const int file = memfd_create("system_call_filter", MFD_CLOEXEC);
  if (file < 0) return errno;
  int error = -seccomp_export_bpf(context.get(), file);
  const off_t size = lseek(file, 0, SEEK_END);
  if (error == 0 && size > 0) {
    program.resize(static_cast<std::size_t>(size) / sizeof(sock_filter));
    if (pread(file, program.data(), static_cast<std::size_t>(size), 0) != size) error = EIO;
  }
  close(file);
  return error;
}

Status not_watched(int error) noexcept {
  return Status::error(StatusCode::unavailable, "the system calls of real-time threads are not watched: %s",
                       strerrordesc_np(error));
}

}  // namespace

Status prepare_system_call_filter() noexcept {
  if (prepared != nullptr) return {};
  const std::uint32_t trap = SECCOMP_RET_TRAP;
  if (syscall(SYS_seccomp, SECCOMP_GET_ACTION_AVAIL, 0, &trap) != 0) return not_watched(errno);
  auto made = std::make_unique<Prepared>();
  if (const int error = write_program(made->program); error != 0) return not_watched(error);
  for (int call = 0; call < call_numbers; ++call)
    made->names[static_cast<std::size_t>(call)] = seccomp_syscall_resolve_num_arch(SCMP_ARCH_NATIVE, call);
  prepare_allocation_guard();  // whose trace is ours too
  if (!last_gasp::handle_with(SIGSYS, &trapped)) return not_watched(errno);
  prepared = made.release();  // for as long as there are threads
  return {};
}

Status filter_system_calls(const char* thread) noexcept {
  if (prepared == nullptr) return {};
  thread_name = thread;
  const std::vector<sock_filter>& program = prepared->program;
  const sock_fprog given{static_cast<unsigned short>(program.size()),
                         const_cast<sock_filter*>(program.data())};  // the kernel's interface has no const
  // Without it only root may filter; and not the other threads, nor the time that a processor's mitigations
  // would cost a thread that distrusts itself.
  if (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0 ||
      syscall(SYS_seccomp, SECCOMP_SET_MODE_FILTER, SECCOMP_FILTER_FLAG_SPEC_ALLOW, &given) != 0)
    return not_watched(errno);
  return {};
}

}  // namespace flexrf
