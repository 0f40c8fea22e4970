#include "benchmarks/panel/process.hpp"

#include <arpa/inet.h>
#include <fcntl.h>
#include <sched.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <thread>

#include "benchmarks/program.hpp"

namespace flexrf::bench {
namespace {

void pin_thread(pid_t thread, int cpu) {
  if (cpu < 0) return;
  cpu_set_t set;
  CPU_ZERO(&set);
  CPU_SET(static_cast<std::size_t>(cpu), &set);
  sched_setaffinity(thread, sizeof(set), &set);
}

}  // namespace

Process::Process(const Settings& settings) {
  int ends[2] = {-1, -1};
  if (pipe2(ends, O_CLOEXEC) != 0) return;
  input_ = ends[1];
  id_ = fork();
  if (id_ == 0) {
    const int output = open(settings.log.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
    dup2(ends[0], STDIN_FILENO);
    dup2(output, STDOUT_FILENO);
    dup2(output, STDERR_FILENO);
    for (const std::string& variable : settings.environment) putenv(const_cast<char*>(variable.c_str()));
    pin_thread(0, settings.cpu);
    become(settings.arguments);
  }
  close(ends[0]);
}

Process::~Process() {
  stop();
}

void Process::reap(int options) {
  if (ended_ || id_ < 0) return;
  ended_ = waitpid(id_, &status_, options) == id_;
}

bool Process::is_running() {
  reap(WNOHANG);
  return id_ > 0 && !ended_;
}

int Process::stop() {
  if (is_running()) {
    kill(id_, SIGCONT);
    kill(id_, SIGINT);
    for (int tries = 0; tries < 500 && is_running(); ++tries) {
      std::this_thread::sleep_for(std::chrono::milliseconds{10});
    }
    if (is_running()) {
      kill(id_, SIGKILL);
      reap(0);
    }
  }
  if (input_ >= 0) close(input_);
  input_ = -1;
  return WIFEXITED(status_) ? WEXITSTATUS(status_) : -1;
}

std::vector<pid_t> Process::threads(std::string_view name) const {
  std::vector<pid_t> found;
  std::error_code error;
  const std::filesystem::path tasks{"/proc/" + std::to_string(id_) + "/task"};
  for (const auto& entry : std::filesystem::directory_iterator(tasks, error)) {
    std::string comm = contents_of(entry.path() / "comm");
    if (!comm.empty()) comm.pop_back();
    if (name.empty() || comm == name) found.push_back(std::atoi(entry.path().filename().c_str()));
  }
  return found;
}

Duration Process::cpu_time(std::string_view thread_name) const {
  Duration sum{};
  for (const pid_t thread : threads(thread_name)) {
    std::ifstream file{"/proc/" + std::to_string(id_) + "/task/" + std::to_string(thread) + "/schedstat"};
    std::int64_t nanoseconds = 0;
    if (file >> nanoseconds) sum += Duration{nanoseconds};
  }
  return sum;
}

void Process::pin(std::string_view thread_name, int cpu) const {
  for (const pid_t thread : threads(thread_name)) pin_thread(thread, cpu);
}

double Process::status_kilobytes(std::string_view line) const {
  std::ifstream file{"/proc/" + std::to_string(id_) + "/status"};
  for (std::string text; std::getline(file, text);) {
    if (text.starts_with(line) && text[line.size()] == ':') return std::atof(text.c_str() + line.size() + 1);
  }
  return 0;
}

std::optional<std::string> output_of(const std::vector<std::string>& arguments, int cpu) {
  int ends[2] = {-1, -1};
  if (pipe2(ends, O_CLOEXEC) != 0) return std::nullopt;
  const pid_t child = fork();
  if (child == 0) {
    dup2(ends[1], STDOUT_FILENO);
    pin_thread(0, cpu);
    become(arguments);
  }
  close(ends[1]);
  std::string output;
  char part[4096];
  for (ssize_t size = 0; (size = read(ends[0], part, sizeof(part))) > 0;) {
    output.append(part, static_cast<std::size_t>(size));
  }
  close(ends[0]);
  int status = 0;
  if (child < 0 || waitpid(child, &status, 0) != child || status != 0) return std::nullopt;
  return output;
}

std::optional<std::string> find_program(const char* name) {
  const char* const path = std::getenv("PATH");
  std::istringstream folders{std::string{path == nullptr ? "" : path} + ":/usr/sbin"};
  for (std::string folder; std::getline(folders, folder, ':');) {
    std::string program = folder + "/" + name;
    if (access(program.c_str(), X_OK) == 0) return program;
  }
  return std::nullopt;
}

std::string contents_of(const std::string& file) {
  std::ifstream stream{file};
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

int free_port() {
  const int socket = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof(address);
  const bool bound = bind(socket, reinterpret_cast<const sockaddr*>(&address), size) == 0 &&
                     getsockname(socket, reinterpret_cast<sockaddr*>(&address), &size) == 0;
  close(socket);
  return bound ? ntohs(address.sin_port) : -1;
}

}  // namespace flexrf::bench
