// Whoever watches and serves a running application from a thread of its own, as the panel does.
#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include "base/status.hpp"
#include "runtime/core/option.hpp"

namespace flexrf {

class Executive;
struct Options;

/// The executive knows no panel; an application's main function brings one along.
class Observer {
 public:
  virtual ~Observer() = default;
  /// After Executive::prepare(), before anything runs: registers requesters, opens sockets. An error refuses
  /// the start. The main thread.
  virtual Status prepare() = 0;
  /// The application's threads are about to start. The observer's own threads inherit from here: the CPUs
  /// that no real-time thread claims, the mask that leaves ending signals to the main thread, ordinary
  /// priority, and, as all memory is locked, stacks of observer_stack_size. An error refuses the start. The
  /// main thread.
  virtual Status start() = 0;
  /// The application ended, its report is still to be written; its objects still stand: ends and joins the
  /// observer's threads. Also after a prepare() or start() that failed or was never called; not when a thread
  /// hangs and the process can only be left. The main thread.
  virtual void stop() noexcept = 0;
};

/// Bytes of the stack of each thread that an observer starts.
inline constexpr std::size_t observer_stack_size = 512U << 10;

/// What an application's main function brings along, so that somebody observes.
struct ObserverPart {
  const char* name;                 ///< "Panel", above its options in --help
  std::span<const Option> options;  ///< of the command line, which it reads itself
  /// Whether it is to be made at all in such a run; an error refuses the start. The main thread, before
  /// anything else.
  Result<bool> (*is_wanted)(const Options& options);
  /// For an application that was prepared; never null.
  std::unique_ptr<Observer> (*make)(Executive& executive);
};

}  // namespace flexrf
