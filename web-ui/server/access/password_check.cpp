#include "web-ui/server/access/password_check.hpp"

#include <fcntl.h>
#include <sched.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>

#include "web-ui/server/access/password.hpp"
#include "web-ui/server/access/password_helper.hpp"

namespace flexrf::panel {
namespace {

/// A pipe that holds the whole input already: nothing is to be written once the process runs.
int filled_pipe(std::string_view hash, std::string_view password) noexcept {
  std::array<char, longest_hash + 1 + longest_password> input{};
  char* end = std::copy(hash.begin(), hash.end(), input.data());
  *end++ = '\n';
  end = std::copy(password.begin(), password.end(), end);
  const auto size = static_cast<std::size_t>(end - input.data());
  int ends[2] = {-1, -1};
  if (pipe2(ends, O_CLOEXEC) != 0) return -1;
  const bool is_written = write(ends[1], input.data(), size) == static_cast<ssize_t>(size);
  close(ends[1]);
  explicit_bzero(input.data(), input.size());
  if (is_written) return ends[0];
  close(ends[0]);
  return -1;
}

/// Attributes and actions of posix_spawn, destroyed again.
struct SpawnSettings {
  SpawnSettings() noexcept {
    posix_spawnattr_init(&attributes);
    posix_spawn_file_actions_init(&actions);
  }
  ~SpawnSettings() {
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
  }
  SpawnSettings(const SpawnSettings&) = delete;
  SpawnSettings& operator=(const SpawnSettings&) = delete;

  /// A process group of its own: Ctrl-C in the terminal is not for it.
  int prepare(int input) noexcept {
    sigset_t none;
    sigset_t all;
    sigemptyset(&none);
    sigfillset(&all);
    const sched_param ordinary{};
    int error = posix_spawnattr_setflags(
        &attributes, static_cast<short>(POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF |
                                        POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSCHEDULER));
    if (error == 0) error = posix_spawnattr_setsigmask(&attributes, &none);
    if (error == 0) error = posix_spawnattr_setsigdefault(&attributes, &all);
    if (error == 0) error = posix_spawnattr_setpgroup(&attributes, 0);
    if (error == 0) error = posix_spawnattr_setschedpolicy(&attributes, SCHED_OTHER);
    if (error == 0) error = posix_spawnattr_setschedparam(&attributes, &ordinary);
    if (error == 0) error = posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
    if (error == 0)
      error = posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    if (error == 0)
      error = posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    if (error == 0) error = posix_spawn_file_actions_addclosefrom_np(&actions, STDERR_FILENO + 1);
    return error;
  }

  posix_spawnattr_t attributes;
  posix_spawn_file_actions_t actions;
};

}  // namespace

PasswordCheck::~PasswordCheck() {
  if (!is_busy()) return;
  kill(child_, SIGKILL);
  waitpid(child_, nullptr, 0);
}

Status PasswordCheck::start(std::string_view hash, std::string_view password, Time now) {
  if (is_busy()) return Status::error(StatusCode::busy, "another password is being checked");
  if (hash.size() > longest_hash || password.size() > longest_password)
    return Status::error(StatusCode::invalid_argument, "a password has at most %zu bytes", longest_password);
  const int input = filled_pipe(hash, password);
  if (input < 0)
    return Status::error(StatusCode::unavailable, "no pipe to check a password with: %s",
                         strerrordesc_np(errno));
  SpawnSettings settings;
  int error = settings.prepare(input);
  char name[] = "flexrf-password-check";
  char argument[32] = {};
  std::strncpy(argument, password_helper_argument, sizeof(argument) - 1);
  char* const arguments[] = {name, argument, nullptr};
  char* const environment[] = {nullptr};
  if (error == 0)
    error = posix_spawn(&child_, executable_.c_str(), &settings.actions, &settings.attributes, arguments,
                        environment);
  close(input);
  if (error != 0) {
    child_ = 0;
    return Status::error(StatusCode::unavailable, "no process to check a password with: %s",
                         strerrordesc_np(error));
  }
  deadline_ = now + time_limit;
  return {};
}

PasswordCheck::Outcome PasswordCheck::update(Time now) noexcept {
  if (!is_busy()) return Outcome::none;
  int status = 0;
  const pid_t ended = waitpid(child_, &status, WNOHANG);
  if (ended == 0) {
    if (now >= deadline_) kill(child_, SIGKILL);
    return Outcome::none;
  }
  if (ended < 0 && errno == EINTR) return Outcome::none;
  child_ = 0;
  if (ended < 0 || !WIFEXITED(status)) return Outcome::failed;
  switch (WEXITSTATUS(status)) {
    case exit_right_password:
      return Outcome::right;
    case exit_wrong_password:
      return Outcome::wrong;
    default:
      return Outcome::failed;
  }
}

}  // namespace flexrf::panel
