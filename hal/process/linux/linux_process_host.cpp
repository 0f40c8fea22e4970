#include "hal/process/linux/linux_process_host.hpp"

#include <poll.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>

namespace flexrf {
namespace {

Status why_refused(const SpawnReport& report, const char* executable) noexcept {
  const char* const reason = std::strerror(report.error);
  switch (report.stage) {
    case SpawnReport::Stage::pipe:
      return Status::error(StatusCode::unavailable, "no pipes for a program: %s", reason);
    case SpawnReport::Stage::fork:
      return Status::error(StatusCode::unavailable, "no process for a program: %s", reason);
    case SpawnReport::Stage::directory:
      return Status::error(StatusCode::not_found, "its working_directory: %s", reason);
    case SpawnReport::Stage::execute:
      break;
  }
  const char* const hint =
      report.error == EACCES    ? "; is it executable for this user?"
      : report.error == ENOEXEC ? "; a script begins with #! and the path of what runs it"
      : report.error == ENOENT  ? "; is it installed, and if it is a script, what its first line names?"
                                : "";
  return Status::error(StatusCode::not_found, "%s cannot be run: %s%s", executable, reason, hint);
}

Status helper_is_gone() noexcept {
  return Status::error(StatusCode::unavailable,
                       "what starts programs, the process flexrf-spawn, has been ended from outside, and the "
                       "program with it; start the application anew");
}

}  // namespace

Status LinuxProcessHost::open(const ProcessProgram& program) {
  if (!helper_.status()) return helper_.status();
  ProcessEvent late;
  while (next_event(late)) {
  }
  if (lost_) return helper_is_gone();
  if (runs_) {
    return Status::error(StatusCode::busy,
                         "the program that was started before has not ended; it waits for the "
                         "kernel, as for a disk or a network folder that does not answer");
  }
  // Whoever reads from us may end at any time; write() then says so.
  struct sigaction action {};
  if (sigaction(SIGPIPE, nullptr, &action) == 0 && action.sa_handler == SIG_DFL)
    std::signal(SIGPIPE, SIG_IGN);
  executable_ = program.executable;
  const Status status = start_.set(program);
  // Where the lifecycle thread may run: not where the real-time threads do.
  if (sched_getaffinity(0, sizeof start_.cpus, &start_.cpus) != 0) CPU_ZERO(&start_.cpus);
  return status;
}

void LinuxProcessHost::wait(Duration most) noexcept {
  pollfd wanted{helper_.control(), POLLIN, 0};
  poll(&wanted, 1, static_cast<int>(std::chrono::ceil<std::chrono::milliseconds>(most).count()));
}

bool LinuxProcessHost::start() noexcept {
  return order(start_, start_.bytes());
}

void LinuxProcessHost::end(bool at_once) noexcept {
  SpawnOrder what;
  what.verb = at_once ? SpawnVerb::end_at_once : SpawnVerb::end_politely;
  order(what, sizeof what.verb);
}

bool LinuxProcessHost::order(const SpawnOrder& what, std::size_t size) const noexcept {
  return send(helper_.control(), &what, size, MSG_DONTWAIT | MSG_NOSIGNAL) == static_cast<ssize_t>(size);
}

bool LinuxProcessHost::next_event(ProcessEvent& event) noexcept {
  if (lost_) return false;
  SpawnReport report;
  iovec part{&report, sizeof report};
  alignas(cmsghdr) char space[CMSG_SPACE(3 * sizeof(int))];
  msghdr message{};
  message.msg_iov = &part;
  message.msg_iovlen = 1;
  message.msg_control = space;
  message.msg_controllen = sizeof space;
  const ssize_t size = recvmsg(helper_.control(), &message, MSG_DONTWAIT | MSG_CMSG_CLOEXEC);
  if (size < 0 && (errno == EAGAIN || errno == EINTR)) return false;
  if (size != sizeof report) return lose(event);
  event = {};
  event.at = Time{Duration{report.at}};
  switch (report.kind) {
    case SpawnReport::Kind::started: {
      release();
      event.kind = ProcessEvent::Kind::started;
      event.id = report.id;
      runs_ = true;
      const cmsghdr* const head = CMSG_FIRSTHDR(&message);
      if (head == nullptr || head->cmsg_len != CMSG_LEN(3 * sizeof(int))) break;
      int descriptors[3];
      std::memcpy(descriptors, CMSG_DATA(head), sizeof descriptors);
      input_ = descriptors[0];
      outputs_[0] = descriptors[1];
      outputs_[1] = descriptors[2];
      break;
    }
    case SpawnReport::Kind::refused:
      event.kind = ProcessEvent::Kind::refused;
      event.cause = why_refused(report, executable_.c_str());
      break;
    case SpawnReport::Kind::ended:
      event.kind = ProcessEvent::Kind::ended;
      runs_ = false;
      if (WIFSIGNALED(report.status)) {
        event.signal = WTERMSIG(report.status);
      } else {
        event.code = WEXITSTATUS(report.status);
      }
      break;
  }
  return true;
}

/// The kernel ends what the helper had started.
bool LinuxProcessHost::lose(ProcessEvent& event) noexcept {
  lost_ = true;
  runs_ = false;
  event = {};
  event.kind = ProcessEvent::Kind::ended;
  event.signal = SIGKILL;
  event.cause = helper_is_gone();
  event.last = true;
  return true;
}

long LinuxProcessHost::read(ProcessSource source, std::span<char> bytes) noexcept {
  int& descriptor = outputs_[static_cast<std::size_t>(source)];
  if (descriptor < 0) return runs_ ? 0 : -1;
  const ssize_t count = ::read(descriptor, bytes.data(), bytes.size());
  if (count > 0) return count;
  if (count < 0 && (errno == EAGAIN || errno == EINTR)) return 0;
  close_descriptor(descriptor);
  return -1;
}

long LinuxProcessHost::write(std::string_view bytes) noexcept {
  if (input_ < 0) return -1;
  const ssize_t count = ::write(input_, bytes.data(), bytes.size());
  if (count >= 0) return count;
  if (errno == EAGAIN || errno == EINTR) return 0;
  close_descriptor(input_);
  return -1;
}

void LinuxProcessHost::release() noexcept {
  close_descriptor(input_);
  for (int& output : outputs_) close_descriptor(output);
}

void LinuxProcessHost::close_descriptor(int& descriptor) noexcept {
  if (descriptor >= 0) ::close(descriptor);
  descriptor = -1;
}

}  // namespace flexrf
