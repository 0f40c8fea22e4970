#include "hal/process/linux/spawn_helper.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/signalfd.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>

#include "base/time.hpp"
#include "hal/process/linux/spawn_order.hpp"

// In the helper and in what it forks nothing may be called that allocates or takes a lock.

namespace flexrf {
namespace {

constexpr int control = 3;  // the helper's end, moved there
constexpr int first_other = 4;

struct Failure {
  SpawnReport::Stage stage;
  int error;
};

void close_all(int (&descriptors)[2]) noexcept {
  for (int& descriptor : descriptors) {
    if (descriptor >= 0) close(descriptor);
    descriptor = -1;
  }
}

void report(const SpawnReport& what, const int* descriptors = nullptr) noexcept {
  iovec part{const_cast<SpawnReport*>(&what), sizeof what};
  alignas(cmsghdr) char space[CMSG_SPACE(3 * sizeof(int))] = {};
  msghdr message{};
  message.msg_iov = &part;
  message.msg_iovlen = 1;
  if (descriptors != nullptr) {
    message.msg_control = space;
    message.msg_controllen = sizeof space;
    cmsghdr* head = CMSG_FIRSTHDR(&message);
    head->cmsg_level = SOL_SOCKET;
    head->cmsg_type = SCM_RIGHTS;
    head->cmsg_len = CMSG_LEN(3 * sizeof(int));
    std::memcpy(CMSG_DATA(head), descriptors, 3 * sizeof(int));
  }
  // Who does not listen any more has gone: the next poll() says so.
  static_cast<void>(sendmsg(control, &message, MSG_NOSIGNAL));
}

/// Gives the program its surroundings and becomes it; writes to `failure` what is in the way.
[[noreturn]] void become(SpawnOrder& order, const int (&ends)[3], int failure, pid_t helper) noexcept {
  const auto give_up = [failure](SpawnReport::Stage stage) {
    const Failure why{stage, errno};
    static_cast<void>(write(failure, &why, sizeof why));
    _exit(127);
  };
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != helper) _exit(127);
  setpgid(0, 0);
  const sched_param ordinary{};
  sched_setscheduler(0, SCHED_OTHER, &ordinary);
  sched_setaffinity(0, sizeof order.cpus, &order.cpus);
  for (int i = 0; i < 3; ++i) dup2(ends[i], i);

  const char* word = order.words.data();
  const auto next = [&word] {
    char* const start = const_cast<char*>(word);
    word += std::strlen(word) + 1;
    return start;
  };
  char* arguments[SpawnOrder::max_words + 1] = {};
  char* variables[SpawnOrder::max_words + 1] = {};
  arguments[0] = next();
  const char* const directory = next();
  for (std::size_t i = 0; i < order.arguments; ++i) arguments[i + 1] = next();
  for (std::size_t i = 0; i < order.variables; ++i) variables[i] = next();
  if (chdir(directory) != 0) give_up(SpawnReport::Stage::directory);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  execve(arguments[0], arguments, variables);
  give_up(SpawnReport::Stage::execute);
  _exit(127);
}

class Helper {
 public:
  [[noreturn]] void run(int signals) noexcept {
    for (;;) {
      pollfd wanted[3] = {{control, POLLIN, 0}, {signals, POLLIN, 0}, {failure_, POLLIN, 0}};
      if (poll(wanted, 3, -1) < 0) continue;
      if (failure_ >= 0 && wanted[2].revents != 0) take_start();
      if (wanted[1].revents != 0) take_signal(signals);
      if (wanted[0].revents != 0) take_order();
    }
  }

 private:
  void take_order() noexcept {
    const ssize_t size = recv(control, &order_, sizeof order_, MSG_DONTWAIT);
    if (size < 0 && (errno == EAGAIN || errno == EINTR)) return;
    if (size <= 0) leave();
    switch (order_.verb) {
      case SpawnVerb::start:
        if (child_ < 0) start();
        break;
      case SpawnVerb::end_politely:
        if (child_ > 0) kill(-child_, SIGTERM);
        break;
      case SpawnVerb::end_at_once:
        end_child();
        break;
    }
  }

  void take_signal(int signals) noexcept {
    signalfd_siginfo info;
    while (read(signals, &info, sizeof info) == sizeof info) {
      if (info.ssi_signo == SIGTERM) leave();
    }
    siginfo_t ended{};
    if (child_ < 0 || waitid(P_PID, static_cast<id_t>(child_), &ended, WEXITED | WNOHANG | WNOWAIT) != 0 ||
        ended.si_pid == 0) {
      return;
    }
    const std::int64_t at = nanoseconds(MonotonicClock::now());
    if (failure_ >= 0) take_start();
    if (child_ < 0) return;
    // What it has started is not left behind; and while it is not reaped, the group's number is nobody
    // else's.
    kill(-child_, SIGKILL);
    int status = 0;
    waitpid(child_, &status, 0);
    child_ = -1;
    SpawnReport what;
    what.kind = SpawnReport::Kind::ended;
    what.status = status;
    what.at = at;
    report(what);
  }

  void start() noexcept {
    int pipes[3][2] = {{-1, -1}, {-1, -1}, {-1, -1}};
    int failure[2] = {-1, -1};
    bool made = pipe2(failure, O_CLOEXEC) == 0;
    for (auto& ends : pipes) made = made && pipe2(ends, O_CLOEXEC) == 0;
    const int error = errno;
    if (!made) {
      refuse(SpawnReport::Stage::pipe, error);
    } else {
      const int theirs[3] = {pipes[0][0], pipes[1][1], pipes[2][1]};
      for (int i = 0; i < 3; ++i) {
        ours_[i] = fcntl(pipes[i][i == 0 ? 1 : 0], F_DUPFD_CLOEXEC, 0);
        fcntl(ours_[i], F_SETFL, O_NONBLOCK);
      }
      const pid_t self = getpid();
      const pid_t child = _Fork();
      if (child == 0) become(order_, theirs, failure[1], self);
      if (child < 0) {
        refuse(SpawnReport::Stage::fork, errno);
        close_ours();
      } else {
        // Orders may come for it before it has done so itself.
        setpgid(child, child);
        child_ = child;
        failure_ = failure[0];
        failure[0] = -1;
      }
    }
    for (auto& ends : pipes) close_all(ends);
    close_all(failure);
  }

  /// The child's own code has begun, or it tells why not.
  void take_start() noexcept {
    Failure why{};
    const ssize_t size = read(failure_, &why, sizeof why);
    close(failure_);
    failure_ = -1;
    if (size == sizeof why) {
      // Before the next start can be ordered: it is at its _exit() already.
      waitpid(child_, nullptr, 0);
      child_ = -1;
      refuse(why.stage, why.error);
    } else {
      SpawnReport what;
      what.kind = SpawnReport::Kind::started;
      what.id = child_;
      what.at = nanoseconds(MonotonicClock::now());
      report(what, ours_);
    }
    close_ours();
  }

  void refuse(SpawnReport::Stage stage, int error) noexcept {
    SpawnReport what;
    what.kind = SpawnReport::Kind::refused;
    what.stage = stage;
    what.error = error;
    report(what);
  }

  void close_ours() noexcept {
    for (int& end : ours_) {
      if (end >= 0) close(end);
      end = -1;
    }
  }

  void end_child() const noexcept {
    if (child_ <= 0) return;
    kill(-child_, SIGKILL);
    kill(child_, SIGKILL);  // before it has a group of its own
  }

  [[noreturn]] void leave() const noexcept {
    // Not waited for: what hangs in the kernel must not hold up the application, which waits for this.
    end_child();
    _exit(0);
  }

  SpawnOrder order_;
  pid_t child_ = -1;
  int failure_ = -1;  // readable when the child's own code has begun, or cannot
  int ours_[3] = {-1, -1, -1};
};

[[noreturn]] void help(int socket, pid_t parent) noexcept {
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() != parent) _exit(0);
  prctl(PR_SET_NAME, "flexrf-spawn");
  // Ctrl-C in the terminal is for the application, which then asks for the programs' end in its order.
  setsid();
  for (int signal = 1; signal < NSIG; ++signal) std::signal(signal, SIG_DFL);
  sigset_t handled;
  sigfillset(&handled);
  sigprocmask(SIG_SETMASK, &handled, nullptr);
  // Out of the way of the numbers that they get.
  const int nowhere = fcntl(open("/dev/null", O_RDWR), F_DUPFD, first_other);
  dup2(fcntl(socket, F_DUPFD, first_other), control);
  for (int i = 0; i < control; ++i) dup2(nowhere, i);
  // The application's lock, devices and sockets are not for the helper to keep open.
  close_range(first_other, ~0U, 0);
  fcntl(control, F_SETFD, FD_CLOEXEC);
  sigemptyset(&handled);
  sigaddset(&handled, SIGCHLD);
  sigaddset(&handled, SIGTERM);
  const int signals = signalfd(-1, &handled, SFD_NONBLOCK | SFD_CLOEXEC);
  static Helper helper;
  helper.run(signals);
}

}  // namespace

SpawnHelper::SpawnHelper() noexcept {
  int ends[2] = {-1, -1};
  if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) != 0) {
    status_ = Status::error(StatusCode::unavailable, "no socket for what starts programs: %s",
                            std::strerror(errno));
    return;
  }
  const pid_t parent = getpid();
  id_ = fork();
  if (id_ == 0) {
    close(ends[0]);
    help(ends[1], parent);
  }
  close(ends[1]);
  control_ = ends[0];
  fcntl(control_, F_SETFL, O_NONBLOCK);
  if (id_ > 0) return;
  status_ =
      Status::error(StatusCode::unavailable, "what starts programs cannot be made: %s", std::strerror(errno));
}

SpawnHelper::~SpawnHelper() {
  if (control_ >= 0) close(control_);
  if (id_ > 0) waitpid(id_, nullptr, 0);
}

}  // namespace flexrf
