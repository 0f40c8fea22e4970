// ValueSaver: keeps in the configuration file what people, scripts and units have set.
#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <string>

#include "base/status.hpp"
#include "base/time.hpp"
#include "runtime/realtime/instance_lock.hpp"
#include "runtime/realtime/thread_setup.hpp"

namespace flexrf {

class Cell;
class Doorbell;

/// How it stands with the configuration file, for whoever shows it.
struct SaveState {
  bool has_file = false;       ///< the application was started with --config FILE
  bool on_change = false;      ///< it is written by itself; false: only when somebody asks
  bool unsaved = false;        ///< somebody set something that the file does not hold yet
  std::uint64_t answered = 0;  ///< requests up to this one are done, and `failure` says how
  std::int64_t saved_at = 0;   ///< ms since 1970: when the last saving succeeded; 0: not yet
  std::uint64_t writings = 0;  ///< of the file since the start, asked for or not
  Status failure;              ///< of the last attempt; ok: the file holds what was set until then
};

/// Reads the file at the start; then a thread of its own writes it: when somebody asks (*Save now*), and, if
/// the application's table does not say `save = { on = "command" }`, after changes (SavePolicy). What it
/// writes it copies from records beside the components, so that it waits for nobody and nobody waits for it.
class ValueSaver {
 public:
  explicit ValueSaver(Cell& cell);
  ValueSaver(const ValueSaver&) = delete;
  ValueSaver& operator=(const ValueSaver&) = delete;
  /// Waits for the thread: not while is_saving(), which only leaving the process ends then.
  ~ValueSaver();

  /// Locks the file against a second run and reads it into the components; tells problems and notices on
  /// standard error. An error: nothing may be started. busy: another process has the file. Main thread, after
  /// Cell::construct().
  Status load();
  /// Rung after each attempt. Before start(); it outlives the thread.
  void set_bell(Doorbell& bell) noexcept { bell_ = &bell; }
  /// Starts the thread; without one (virtual time) whoever asks saves. Main thread.
  Status start() noexcept;

  /// *Save now*: begins it, and gives the number under which state() tells that it is done. Does not wait.
  /// not_permitted: there is no file, or the application has ended. Any thread that is not real-time.
  Result<std::uint64_t> request();
  /// Any thread that is not real-time.
  SaveState state() const;
  /// Another number whenever state() says something new. Any thread.
  std::uint64_t revision() const noexcept;

  /// The end: saves a last time, unless that is done on command only; ends the thread. Waits for it, but no
  /// longer than 10 s. An error: something that was set, or asked to be saved, is not in the file. Main
  /// thread.
  Status finish();
  /// finish() waited in vain: the process can only be left by _exit().
  bool is_saving() const noexcept { return thread_.is_started() && !ended_.load(std::memory_order_acquire); }

 private:
  void run() noexcept;
  bool is_due(Time now) noexcept;
  bool is_unsaved() const noexcept;
  void save();
  Status write_file() const;
  void tell(const Status& status, bool asked);
  void tell_wear(std::uint64_t writings);

  Cell* cell_;
  Doorbell* bell_ = nullptr;
  InstanceLock lock_;
  RunningThread thread_;
  std::atomic<bool> ends_{false};
  std::atomic<bool> ended_{false};
  std::atomic<std::uint64_t> wanted_{0};          ///< number of the last request
  std::atomic<std::uint64_t> saved_revision_{0};  ///< of the cell's settings, as they are in the file
  std::atomic<std::uint64_t> attempts_{0};
  mutable std::mutex mutex_;
  SaveState state_;  ///< but for has_file, on_change and unsaved
  bool closed_ = false;
  // Of the thread.
  std::uint64_t seen_revision_ = 0;
  Time first_change_{};  ///< that is not saved; 0: there is none
  Time last_change_{};
  Time last_attempt_{};
  Status told_;
  std::uint64_t tell_wear_at_;  ///< writings
};

}  // namespace flexrf
