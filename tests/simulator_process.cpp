#include "tests/simulator_process.hpp"

#include <poll.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>

namespace flexrf {
namespace {

// Against what hangs, in ms.
constexpr int patience = 30'000;
constexpr int cannot_be_run = 127;

}  // namespace

SimulatorProcess::SimulatorProcess(const std::string& executable, const std::vector<std::string>& arguments) {
  std::vector<std::string> words{executable};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  pointers.reserve(words.size() + 1);
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  // A socket, not two pipes: writing to who has ended can be told to raise no signal.
  std::array<int, 2> ends{};
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) return;
  const pid_t parent = getpid();
  process_ = fork();
  if (process_ == 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) _exit(cannot_be_run);  // it ended before that was said
    dup2(ends[1], STDIN_FILENO);
    dup2(ends[1], STDOUT_FILENO);
    execv(executable.c_str(), pointers.data());
    _exit(cannot_be_run);
  }
  close(ends[1]);
  conversation_ = ends[0];
  if (process_ > 0) first_line_ = read_line(patience);
}

SimulatorProcess::~SimulatorProcess() {
  kill();
  if (conversation_ >= 0) close(conversation_);
}

std::string SimulatorProcess::ask(std::string_view line) {
  const std::string text = std::string(line) + "\n";
  if (!is_running() ||
      send(conversation_, text.data(), text.size(), MSG_NOSIGNAL) != static_cast<ssize_t>(text.size())) {
    return {};
  }
  return read_line(patience);
}

void SimulatorProcess::pause() {
  if (process_ > 0) ::kill(process_, SIGSTOP);
}

void SimulatorProcess::resume() {
  if (process_ > 0) ::kill(process_, SIGCONT);
}

void SimulatorProcess::kill() {
  if (process_ <= 0) return;
  ::kill(process_, SIGKILL);
  waitpid(process_, nullptr, 0);
  process_ = -1;
}

std::string SimulatorProcess::read_line(int milliseconds) {
  while (true) {
    if (const std::size_t end = read_.find('\n'); end != std::string::npos) {
      std::string line = read_.substr(0, end);
      read_.erase(0, end + 1);
      return line;
    }
    pollfd wanted{conversation_, POLLIN, 0};
    std::array<char, 256> text{};
    if (poll(&wanted, 1, milliseconds) != 1) return {};
    const ssize_t size = read(conversation_, text.data(), text.size());
    if (size <= 0) return {};
    read_.append(text.data(), static_cast<std::size_t>(size));
  }
}

}  // namespace flexrf
