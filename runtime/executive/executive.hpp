// Executive: runs one application from its first to its last breath.
#pragma once

#include <atomic>
#include <csignal>
#include <deque>
#include <functional>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "runtime/executive/audit.hpp"
#include "runtime/executive/cell.hpp"
#include "runtime/executive/component_actions.hpp"
#include "runtime/executive/lifecycle.hpp"
#include "runtime/executive/motion_permit.hpp"
#include "runtime/executive/observer.hpp"
#include "runtime/executive/output_thread.hpp"
#include "runtime/executive/reconfiguration.hpp"
#include "runtime/executive/run_summary.hpp"
#include "runtime/executive/supervision.hpp"
#include "runtime/executive/thread_loop.hpp"
#include "runtime/executive/value_saver.hpp"
#include "runtime/log/log.hpp"
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
  /// After run(): the rest of the log, then these on standard output. Waits for whoever reads them; when a
  /// signal or a fault ended the application 2 s at most, and never longer than to the next ending signal.
  /// What comes back is what is not there as a whole, the log and the audit among it; timeout: nobody reads
  /// it.
  std::vector<Status> say_last(std::vector<std::string> texts);
  /// say_last() waited in vain: the process can only be left by _exit().
  bool is_still_saying() const noexcept { return output_.is_ending() || audit_.is_ending(); }
  /// The file system of the configuration file does not answer: likewise.
  bool is_still_saving() const noexcept { return saver_.is_saving(); }

  /// Changes configuration parameters of the running application, as one transaction; waits for the outcome.
  /// Another thread than run()'s, not real-time, while the application runs.
  ReconfigureResult reconfigure(std::vector<ConfigurationChange> changes);

  // ---- for another thread that is not real-time, while the application runs; none of these waits

  /// Told once, on the lifecycle thread, how it went: it must not wait, nor call what waits for that thread.
  /// At once and on the caller's thread when the application has ended.
  using ActionDone = std::function<void(const Status&)>;
  using ReconfigureDone = std::function<void(const ReconfigureResult&)>;

  /// `who` asks, for the audit.
  void act(ComponentAction action, ComponentIndex component, ActionDone done, std::string_view who = {});
  /// As reconfigure(), without waiting.
  void reconfigure(std::vector<ConfigurationChange> changes, ReconfigureDone done, std::string_view who = {});
  /// What a reconfiguration of these would stop and initialise again, in order of stopping: what actuates
  /// first.
  std::vector<ComponentIndex> owners_of(std::span<const ComponentIndex> changed);
  /// What may move now or is not yet at rest, see moving_components(). Empty: motion is stopped.
  std::vector<ComponentIndex> moving() const { return moving_components(cell_); }
  /// The controlled stop of the whole application.
  void request_end() noexcept;
  /// *Save now*, and how it stands with the configuration file.
  ValueSaver& saver() noexcept { return saver_; }

  /// Whom run() starts with the application's threads. Its maker stops it, after run(). Before run().
  void set_observer(Observer& observer) noexcept { observer_ = &observer; }

  /// What the terminal shows meanwhile. Before run().
  void set_view(MakeView make) noexcept { output_.set_view(make); }

  Cell& cell() noexcept { return cell_; }
  const Options& options() const noexcept { return options_; }
  Lifecycle& lifecycle() noexcept { return lifecycle_; }
  Control& control() noexcept { return cell_.control(); }
  Audit& audit() noexcept { return audit_; }

 private:
  void run_on_the_wall_clock(RunSummary& summary);
  void run_in_virtual_time(RunSummary& summary);
  Status start_threads(RunSummary& summary);
  Status start_observer();
  void supervise(RunSummary& summary);
  void obey(const siginfo_t& sent, RunSummary& summary) noexcept;
  void live();  // the lifecycle thread
  void join_threads() noexcept;
  void begin_running() noexcept;
  void use_log_time(Time time) noexcept;

  Options options_;
  Cell cell_;
  Lifecycle lifecycle_;
  Observer* observer_ = nullptr;
  std::deque<ThreadLoop> loops_;
  std::deque<RunningThread> threads_;
  std::atomic<bool> lives_{false};
  bool asked_to_end_ = false;  // by a signal; the main thread
  LogLimit useless_signal_;
  LogLimit replaced_handler_;
  Time log_time_{};  // of what is said before and after virtual time runs
  Time began_{};
  ValueSaver saver_;
  MotionPermit permit_;
  OutputThread output_;
  Audit audit_;  // says in the log what it writes: ends before the output does
};

}  // namespace flexrf
