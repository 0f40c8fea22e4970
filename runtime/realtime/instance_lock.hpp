// One running instance per cell, and per file that a cell writes.
#pragma once

#include <cstddef>

#include "base/status.hpp"

namespace flexrf {

/// For whom a cell is there once.
enum class LockScope {
  machine,  ///< it moves something real: /run/flexrf, whoever starts it
  user,     ///< nothing of it is there but for whoever runs it: $XDG_RUNTIME_DIR, or a folder in /tmp that is
            ///< the user's
};
inline constexpr std::size_t lock_directory_size = 200;
/// Where the lock file belongs; root makes /run/flexrf when it is not there. not_permitted: it is not there,
/// or not for this user; the cause names the command that makes it. Main thread, at start.
Status find_lock_directory(LockScope scope, char (&path)[lock_directory_size]) noexcept;

/// Holds the lock file of a cell, or of a file, until released or the process ends, however it ends.
/// Lifecycle thread.
class InstanceLock {
 public:
  InstanceLock() noexcept = default;
  InstanceLock(const InstanceLock&) = delete;
  InstanceLock& operator=(const InstanceLock&) = delete;
  ~InstanceLock() { release(); }

  /// Takes flexrf-CELL.lock in `directory`. busy: another process holds it; the cause names its number,
  /// command and since when.
  Status acquire(const char* cell, const char* directory) noexcept;
  /// Takes `path`, which is made when it is not there. `what` begins the cause of busy, "cell jog is run" or
  /// "file x is used".
  Status acquire_file(const char* path, const char* what) noexcept;
  void release() noexcept;
  bool is_held() const noexcept { return descriptor_ >= 0; }
  const char* path() const noexcept { return path_; }

 private:
  int descriptor_ = -1;
  char path_[1024] = {};
};

}  // namespace flexrf
