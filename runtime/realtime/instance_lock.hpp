// One running instance per cell.
#pragma once

#include "runtime/core/status.hpp"

namespace flexrf {

/// Holds the lock file of a cell until released or the process ends, however it ends. Lifecycle thread.
class InstanceLock {
 public:
  InstanceLock() noexcept = default;
  InstanceLock(const InstanceLock&) = delete;
  InstanceLock& operator=(const InstanceLock&) = delete;
  ~InstanceLock() { release(); }

  /// Takes flexrf-CELL.lock in `directory`; null: the first of /run/flexrf, $XDG_RUNTIME_DIR, /tmp that may
  /// be written to. busy: another process holds it; the cause names its number, command and since when.
  Status acquire(const char* cell, const char* directory = nullptr) noexcept;
  void release() noexcept;
  bool is_held() const noexcept { return descriptor_ >= 0; }
  const char* path() const noexcept { return path_; }

 private:
  int descriptor_ = -1;
  char path_[256] = {};
};

}  // namespace flexrf
