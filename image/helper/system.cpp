#include "image/helper/system.hpp"

#include <pwd.h>
#include <spawn.h>
#include <sys/statvfs.h>
#include <sys/wait.h>
#include <unistd.h>

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

}  // namespace

std::string run_program(const std::string& program, const std::vector<std::string>& arguments) {
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
  pid_t child = 0;
  if (const int error =
          posix_spawn(&child, program.c_str(), nullptr, &attributes.value, words.data(), environ);
      error != 0)
    return program + " cannot be run: " + strerrordesc_np(error);
  int status = 0;
  while (waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) return program + " cannot be waited for: " + strerrordesc_np(errno);
  }
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return {};
  return program + (WIFEXITED(status) ? " ended with " + std::to_string(WEXITSTATUS(status))
                                      : " was ended by signal " + std::to_string(WTERMSIG(status)));
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
