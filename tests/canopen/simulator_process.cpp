#include "tests/canopen/simulator_process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

namespace flexrf {

SimulatorProcess::SimulatorProcess(const char* executable, const char* interface, const char* node,
                                   const char* option) {
  int in[2];
  int out[2];
  if (::pipe2(in, O_CLOEXEC) != 0) return;
  if (::pipe2(out, O_CLOEXEC) != 0) {
    ::close(in[0]);
    ::close(in[1]);
    return;
  }
  process_ = ::fork();
  if (process_ == 0) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    ::dup2(in[0], STDIN_FILENO);
    ::dup2(out[1], STDOUT_FILENO);
    ::execl(executable, executable, interface, "--node", node, option, static_cast<char*>(nullptr));
    ::_exit(127);
  }
  ::close(in[0]);
  ::close(out[1]);
  to_ = in[1];
  from_ = out[0];
  running_ = process_ > 0 && !read_line().empty();
}

SimulatorProcess::~SimulatorProcess() {
  if (to_ >= 0) ::close(to_);
  if (from_ >= 0) ::close(from_);
  if (process_ <= 0) return;
  ::kill(process_, SIGKILL);
  ::waitpid(process_, nullptr, 0);
}

std::string SimulatorProcess::ask(std::string_view line) {
  const std::string text = std::string(line) + "\n";
  if (!running_ || ::write(to_, text.data(), text.size()) != static_cast<ssize_t>(text.size())) return "";
  return read_line();
}

std::string SimulatorProcess::read_line() {
  constexpr int limit = 30'000;  // ms
  for (;;) {
    if (const std::size_t end = read_.find('\n'); end != std::string::npos) {
      std::string line = read_.substr(0, end);
      read_.erase(0, end + 1);
      return line;
    }
    pollfd wanted{from_, POLLIN, 0};
    char text[256];
    if (::poll(&wanted, 1, limit) != 1) return "";
    const ssize_t size = ::read(from_, text, sizeof text);
    if (size <= 0) return "";
    read_.append(text, static_cast<std::size_t>(size));
  }
}

}  // namespace flexrf
