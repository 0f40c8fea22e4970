// Whoever watches and serves a running application from a thread of its own, as the panel does.
#pragma once

#include <memory>

#include "runtime/core/status.hpp"

namespace flexrf {

class Executive;

/// The executive knows no panel; an application's main function brings one along.
class Observer {
 public:
  virtual ~Observer() = default;
  /// After Executive::prepare(), before anything runs: registers requesters, opens sockets. An error refuses
  /// the start. The main thread.
  virtual Status prepare() = 0;
  /// The application's threads are about to start; the observer's own threads inherit CPUs and signal mask
  /// from here. The main thread.
  virtual Status start() = 0;
  /// The application ended, its objects still stand: ends and joins the observer's threads. The main thread.
  virtual void stop() noexcept = 0;
};

/// Null: nothing to observe (as `--panel off`).
using MakeObserver = std::unique_ptr<Observer> (*)(Executive& executive);

}  // namespace flexrf
