#include "runtime/realtime/instance_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>

namespace flexrf {

namespace {

/// "process 1234 (./keyboard --panel), since 2026-03-01 12:00:00".
void describe_self(char* text, std::size_t capacity) noexcept {
  char command[128] = {};
  const int file = open("/proc/self/cmdline", O_RDONLY | O_CLOEXEC);
  if (file >= 0) {
    const ssize_t size = read(file, command, sizeof(command) - 1);
    close(file);
    // Arguments are separated by zeros; what could break the line or the terminal becomes a blank.
    for (ssize_t i = 0; i + 1 < size; ++i)
      if (static_cast<unsigned char>(command[i]) < 0x20) command[i] = ' ';
  }
  const std::time_t now = std::time(nullptr);
  std::tm local{};
  localtime_r(&now, &local);
  char since[32];
  std::strftime(since, sizeof(since), "%Y-%m-%d %H:%M:%S", &local);
  std::snprintf(text, capacity, "process %d (%s), since %s", getpid(), command, since);
}

constexpr const char* machine_directory = "/run/flexrf";

/// Of this user alone, so that nobody else can have put anything there.
bool is_own(const char* directory) noexcept {
  struct stat found {};
  return lstat(directory, &found) == 0 && S_ISDIR(found.st_mode) && found.st_uid == geteuid() &&
         (found.st_mode & (S_IWGRP | S_IWOTH)) == 0;
}

}  // namespace

Status find_lock_directory(LockScope scope, char (&path)[lock_directory_size]) noexcept {
  if (scope == LockScope::machine) {
    std::snprintf(path, sizeof(path), "%s", machine_directory);
    // What root makes here is root's alone, until somebody sets it up for a group.
    if (geteuid() == 0) mkdir(machine_directory, 0755);
    if (access(machine_directory, W_OK | X_OK) == 0) return {};
    return Status::error(
        StatusCode::not_permitted,
        "real actuators are run by one process of the whole machine, and its lock file belongs into %s: "
        "%s; make it by `sudo install -d -m 2775 -g $(id -gn) %s` (docs/stopping.md)",
        machine_directory, strerrordesc_np(errno), machine_directory);
  }
  const char* const user = std::getenv("XDG_RUNTIME_DIR");  // NOLINT(concurrency-mt-unsafe): at start
  if (user != nullptr && user[0] == '/' && std::strlen(user) < sizeof(path) && is_own(user)) {
    std::snprintf(path, sizeof(path), "%s", user);
    return {};
  }
  std::snprintf(path, sizeof(path), "/tmp/flexrf-%u", geteuid());
  mkdir(path, 0700);
  if (is_own(path)) return {};
  return Status::error(
      StatusCode::not_permitted,
      "the lock file's folder %s is not this user's alone: remove it, or set XDG_RUNTIME_DIR", path);
}

Status InstanceLock::acquire(const char* cell, const char* directory) noexcept {
  char path[sizeof(path_)];
  char what[128];
  std::snprintf(what, sizeof(what), "cell %s is run", cell);
  const int length = std::snprintf(path, sizeof(path), "%s/flexrf-%s.lock", directory, cell);
  if (length < 0 || static_cast<std::size_t>(length) >= sizeof(path))
    return Status::error(StatusCode::invalid_argument, "the lock file's path is too long: %.100s...", path);
  return acquire_file(path, what);
}

Status InstanceLock::acquire_file(const char* path, const char* what) noexcept {
  if (is_held()) return Status::error(StatusCode::busy, "this process holds %s already", path_);
  const int length = std::snprintf(path_, sizeof(path_), "%s", path);
  if (length < 0 || static_cast<std::size_t>(length) >= sizeof(path_))
    return Status::error(StatusCode::invalid_argument, "the lock file's path is too long: %.100s...", path_);
  // Another user's file may be read and locked, but not opened for writing.
  int file = open(path_, O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0644);
  const bool is_writable = file >= 0;
  if (!is_writable) file = open(path_, O_RDONLY | O_CLOEXEC | O_NOFOLLOW);
  if (file < 0)
    return Status::error(StatusCode::unavailable, "cannot open the lock file %s: %s", path_,
                         strerrordesc_np(errno));
  if (flock(file, LOCK_EX | LOCK_NB) != 0) {
    const int cause = errno;
    char holder[160] = {};
    const ssize_t size = pread(file, holder, sizeof(holder) - 1, 0);
    close(file);
    if (cause != EWOULDBLOCK)
      return Status::error(StatusCode::unavailable, "cannot lock %s: %s", path_, strerrordesc_np(cause));
    if (char* const end = std::strchr(holder, '\n')) *end = '\0';
    return Status::error(StatusCode::busy, "%s already by %s; lock file %s", what,
                         size > 0 ? holder : "a process that has not said its name", path_);
  }
  if (is_writable) {
    char text[224];
    describe_self(text, sizeof(text) - 1);
    std::strcat(text, "\n");
    // The lock is what counts; that its holder cannot be named (a full disk) is no reason not to run.
    [[maybe_unused]] const bool named =
        ftruncate(file, 0) == 0 && pwrite(file, text, std::strlen(text), 0) > 0;
  }
  descriptor_ = file;
  return {};
}

void InstanceLock::release() noexcept {
  if (!is_held()) return;
  // The file stays: removing it could leave two processes with a lock each, on two files of one name.
  close(descriptor_);
  descriptor_ = -1;
}

}  // namespace flexrf
