#pragma once

#include <sys/types.h>

#include "base/status.hpp"

namespace flexrf {

/// A process of its own that starts programs for this one. fork() of a running cell would mark all its memory
/// copy-on-write, locked or not, and every real-time thread would pay with page faults: so the helper is
/// forked while there is nothing of that yet, and forks in its place.
///
/// It ends with this process or with its control socket, and takes with it what it has started. It allocates
/// nothing, so that it may be forked from a process with threads too.
class SpawnHelper {
 public:
  /// The main thread, before real-time threads are started and memory is locked. It lives as long as the
  /// thread that makes it.
  SpawnHelper() noexcept;
  ~SpawnHelper();
  SpawnHelper(const SpawnHelper&) = delete;
  SpawnHelper& operator=(const SpawnHelper&) = delete;

  /// Why there is none.
  const Status& status() const noexcept { return status_; }
  /// A non-blocking SOCK_SEQPACKET socket for orders and reports.
  int control() const noexcept { return control_; }
  pid_t id() const noexcept { return id_; }

 private:
  Status status_;
  int control_ = -1;
  pid_t id_ = -1;
};

}  // namespace flexrf
