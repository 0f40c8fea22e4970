// HelperThread: the thread of a driver that may wait, as its cycles may not: it opens, looks for what was
// lost, listens.
#pragma once

#include <poll.h>

#include <cstddef>
#include <span>

#include "base/status.hpp"
#include "base/time.hpp"
#include "runtime/realtime/thread_setup.hpp"

namespace flexrf {

/// Not real-time, on every CPU that the process may use, with a small stack of its own, as all of it is
/// locked in memory (of the usual one 8 MiB would be), and takes no signal but those of a crash. The object
/// outlives the driver's use of it.
class HelperThread {
 public:
  /// Guard page included. The budget of an application counts it.
  static constexpr std::size_t stack_size = 256 * 1024;
  /// The most descriptors that wait() can watch.
  static constexpr std::size_t most_sources = 3;

  HelperThread() = default;
  ~HelperThread() { end(); }
  HelperThread(const HelperThread&) = delete;
  HelperThread& operator=(const HelperThread&) = delete;

  // ---- the lifecycle thread's

  /// Begins `owner`.work(), which returns as soon as wait() has said so. `name` is the device's; the kernel
  /// shows its first 15 bytes. Error: the system gives no thread, or one runs already.
  template <class Owner, void (Owner::*work)()>
  Status begin(const char* name, Owner& owner) noexcept {
    return begin(
        name, [](void* self) { (static_cast<Owner*>(self)->*work)(); }, &owner);
  }
  /// Returns when work() has. Nothing where none runs.
  void end() noexcept;

  // ---- its own

  /// Until one of `sources` (at most most_sources) has something to say, which is in its revents, or this
  /// time has passed, at most. False: it is to end.
  bool wait(Duration longest, std::span<pollfd> sources = {}) noexcept;

 private:
  Status begin(const char* name, void (*work)(void*), void* owner) noexcept;

  int ending_ = -1;  // an eventfd: readable when it is to end
  RunningThread thread_;
};

}  // namespace flexrf
