// Output: what an application says to the terminal, or to whatever reads its standard output and error.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "runtime/realtime/thread_setup.hpp"
#include "runtime/run/status_view.hpp"

namespace flexrf {

/// A thread that writes the log, the status view and at the end the report. It may wait for a reader that is
/// slow, stopped or stuck, so that nobody who supervises does. All functions: one thread, not real-time.
class OutputThread {
 public:
  /// `status_view`: where standard output is a terminal, its last lines show the running application.
  OutputThread(Cell& cell, bool status_view);
  OutputThread(const OutputThread&) = delete;
  OutputThread& operator=(const OutputThread&) = delete;
  /// Waits for the thread: not while is_ending() is true, which only leaving the process ends then.
  ~OutputThread();

  Status start() noexcept;
  /// In every turn of the supervising thread: where the log's reader is stuck, the log goes to the panel all
  /// the same. Never waits.
  void observe() noexcept;

  /// What was logged so far is formatted, for who looks at it afterwards (logged_warnings()). Waits for the
  /// thread, not for its reader.
  void catch_up() noexcept;

  /// Takes the status view away, then writes the rest of the log and these texts on standard output. Once;
  /// does not wait.
  void begin_end(std::vector<std::string> texts) noexcept;
  /// Not all of it is written yet.
  bool is_ending() const noexcept { return !ended_.load(std::memory_order_acquire); }
  /// Why not all of it was written; ok when it was. After is_ending() became false.
  const Status& failure() const noexcept { return failure_; }

 private:
  void run() noexcept;
  void write_texts() noexcept;

  Cell* cell_;
  bool status_view_;
  std::atomic<bool> ends_{false};
  std::atomic<bool> ended_{false};
  std::atomic<std::uint32_t> turns_{0};
  std::vector<std::string> texts_;
  Status failure_;
  RunningThread thread_;
};

}  // namespace flexrf
