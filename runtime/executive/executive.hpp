// Executive: runs one application from its first to its last breath.
#pragma once

#include <atomic>
#include <deque>
#include <memory>
#include <vector>

#include "runtime/executive/cell.hpp"
#include "runtime/executive/lifecycle.hpp"
#include "runtime/executive/reconfiguration.hpp"
#include "runtime/executive/run_summary.hpp"
#include "runtime/executive/supervision.hpp"
#include "runtime/executive/thread_loop.hpp"
#include "runtime/realtime/thread_setup.hpp"

namespace flexrf {

/// One application, one run. Made and run by the main thread (in tests: any one thread that is not
/// real-time).
class Executive {
 public:
  Executive(const Application& application, Options options);
  Executive(const Executive&) = delete;
  Executive& operator=(const Executive&) = delete;
  ~Executive();

  /// Constructs and connects; chooses hardware; checks rights. Nothing runs yet: requesters may be added.
  /// not_permitted: a right is missing (exit code 3); others: exit code 1 or 2.
  Status prepare();
  /// Until the application ended. Signals SIGINT and SIGTERM end it by a controlled stop.
  RunSummary run();

  /// Changes configuration parameters of the running application, as one transaction; waits for the outcome.
  /// Another thread than run()'s, not real-time, while the application runs.
  ReconfigureResult reconfigure(std::vector<ConfigurationChange> changes);

  Cell& cell() noexcept { return cell_; }
  Lifecycle& lifecycle() noexcept { return lifecycle_; }
  Control& control() noexcept { return cell_.control(); }

 private:
  void run_on_the_wall_clock(RunSummary& summary);
  void run_in_virtual_time(RunSummary& summary);
  Status start_threads(RunSummary& summary);
  void supervise(RunSummary& summary);
  void live();  // the lifecycle thread
  void join_threads() noexcept;
  void begin_running() noexcept;
  Status load_values();
  void save_values();

  Options options_;
  Cell cell_;
  Lifecycle lifecycle_;
  std::deque<ThreadLoop> loops_;
  std::deque<RunningThread> threads_;
  Status start_status_;
  std::atomic<bool> lives_{false};
  Time began_{};
};

}  // namespace flexrf
