#include "image/helper/system.hpp"

#include <fcntl.h>
#include <poll.h>
#include <pwd.h>
#include <spawn.h>
#include <sys/statvfs.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>

namespace flexrf::helper {
namespace {

/// Of posix_spawn, destroyed again.
struct SpawnAttributes {
  SpawnAttributes() noexcept { posix_spawnattr_init(&value); }
  ~SpawnAttributes() { posix_spawnattr_destroy(&value); }
  SpawnAttributes(const SpawnAttributes&) = delete;
  SpawnAttributes& operator=(const SpawnAttributes&) = delete;
  posix_spawnattr_t value;
};

struct SpawnActions {
  SpawnActions() noexcept { posix_spawn_file_actions_init(&value); }
  ~SpawnActions() { posix_spawn_file_actions_destroy(&value); }
  SpawnActions(const SpawnActions&) = delete;
  SpawnActions& operator=(const SpawnActions&) = delete;
  posix_spawn_file_actions_t value;
};

/// errno's value; 0: the program runs as `child`.
int spawn(const std::string& program, const std::vector<std::string>& arguments,
          const posix_spawn_file_actions_t* actions, pid_t& child) {
  std::string name = program;
  std::vector<std::string> texts = arguments;
  std::vector<char*> words{name.data()};
  for (std::string& text : texts) words.push_back(text.data());
  words.push_back(nullptr);
  // This process's signals are blocked and ignored for its own reasons.
  SpawnAttributes attributes;
  sigset_t none;
  sigset_t all;
  sigemptyset(&none);
  sigfillset(&all);
  posix_spawnattr_setsigmask(&attributes.value, &none);
  posix_spawnattr_setsigdefault(&attributes.value, &all);
  posix_spawnattr_setflags(&attributes.value, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
  return posix_spawn(&child, program.c_str(), actions, &attributes.value, words.data(), environ);
}

/// Empty: the child ended with 0; else why not, in one line.
std::string failure_of(const std::string& program, pid_t child) {
  int status = 0;
  while (waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) return program + " cannot be waited for: " + strerrordesc_np(errno);
  }
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return {};
  return program + (WIFEXITED(status) ? " ended with " + std::to_string(WEXITSTATUS(status))
                                      : " was ended by signal " + std::to_string(WTERMSIG(status)));
}

/// Until the other end is closed.
Status read_all(int pipe, Time end, std::size_t most, std::string& text) {
  std::array<char, 4096> bytes{};
  while (true) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(end - MonotonicClock::now());
    pollfd polled{pipe, POLLIN, 0};
    if (left.count() <= 0 || poll(&polled, 1, static_cast<int>(left.count())) == 0)
      return Status::error(StatusCode::timeout, "it took too long");
    const ssize_t count = read(pipe, bytes.data(), bytes.size());
    if (count == 0) return {};
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return Status::error(StatusCode::unavailable, "%s", strerrordesc_np(errno));
    text.append(bytes.data(), static_cast<std::size_t>(count));
    if (text.size() > most) return Status::error(StatusCode::out_of_range, "it wrote too much");
  }
}

}  // namespace

std::string run_program(const std::string& program, const std::vector<std::string>& arguments) {
  pid_t child = 0;
  if (const int error = spawn(program, arguments, nullptr, child); error != 0)
    return program + " cannot be run: " + strerrordesc_np(error);
  return failure_of(program, child);
}

Result<std::string> output_of(const std::string& program, const std::vector<std::string>& arguments,
                              Duration wait, std::size_t most) {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0)
    return Status::error(StatusCode::unavailable, "no pipe to %s: %s", program.c_str(),
                         strerrordesc_np(errno));
  SpawnActions actions;
  posix_spawn_file_actions_adddup2(&actions.value, ends[1], STDOUT_FILENO);
  pid_t child = 0;
  const int error = spawn(program, arguments, &actions.value, child);
  close(ends[1]);
  if (error != 0) {
    close(ends[0]);
    return Status::error(StatusCode::unavailable, "%s cannot be run: %s", program.c_str(),
                         strerrordesc_np(error));
  }
  std::string text;
  const Status read = read_all(ends[0], MonotonicClock::now() + wait, most, text);
  if (!read) kill(child, SIGKILL);
  close(ends[0]);
  const std::string failure = failure_of(program, child);
  if (!read) return Status::error(read.code(), "%s: %s", program.c_str(), read.cause());
  if (!failure.empty()) return Status::error(StatusCode::unavailable, "%s", failure.c_str());
  return text;
}

std::uint64_t free_bytes(const std::string& folder) {
  struct statvfs status {};
  if (statvfs(folder.c_str(), &status) != 0) return 0;
  // Root may write where the application may not any more (keep-room).
  return static_cast<std::uint64_t>(status.f_bfree) * status.f_frsize;
}

std::optional<uid_t> id_of_user(const std::string& name) {
  const passwd* const found = getpwnam(name.c_str());
  return found == nullptr ? std::nullopt : std::optional{found->pw_uid};
}

}  // namespace flexrf::helper
