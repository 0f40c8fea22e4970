#include "tests/grippers/robotiq_simulator_process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>

extern char** environ;

namespace flexrf {

RobotiqSimulatorProcess::RobotiqSimulatorProcess(const std::vector<std::string>& words) {
  // One that ended is noticed by its answer.
  std::signal(SIGPIPE, SIG_IGN);
  std::array<int, 2> to{};
  std::array<int, 2> from{};
  if (pipe2(to.data(), O_CLOEXEC) != 0) return;
  if (pipe2(from.data(), O_CLOEXEC) != 0) {
    close(to[0]);
    close(to[1]);
    return;
  }
  std::vector<std::string> all{ROBOTIQ_SIMULATOR};
  all.insert(all.end(), words.begin(), words.end());
  std::vector<char*> arguments;
  arguments.reserve(all.size() + 1);
  for (std::string& word : all) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, to[0], STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, from[1], STDOUT_FILENO);
  if (posix_spawn(&id_, ROBOTIQ_SIMULATOR, &actions, nullptr, arguments.data(), environ) != 0) id_ = -1;
  posix_spawn_file_actions_destroy(&actions);
  close(to[0]);
  close(from[1]);
  input_ = to[1];
  output_ = from[0];
  if (id_ > 0) line_ = read_line();
}

RobotiqSimulatorProcess::~RobotiqSimulatorProcess() {
  if (id_ > 0) {
    kill(id_, SIGKILL);
    waitpid(id_, nullptr, 0);
  }
  if (input_ >= 0) close(input_);
  if (output_ >= 0) close(output_);
}

std::string RobotiqSimulatorProcess::ask(const std::string& command) {
  const std::string line = command + "\n";
  if (write(input_, line.data(), line.size()) != static_cast<ssize_t>(line.size())) return {};
  return read_line();
}

std::string RobotiqSimulatorProcess::read_line() {
  constexpr int patience = 30'000;  // ms
  std::string line;
  while (true) {
    pollfd ready{output_, POLLIN, 0};
    char character = 0;
    if (poll(&ready, 1, patience) <= 0 || read(output_, &character, 1) != 1) return {};
    if (character == '\n') return line;
    line += character;
  }
}

}  // namespace flexrf
