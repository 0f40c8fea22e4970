// Output: what an application says to the terminal, or to whatever reads its standard output and error.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "runtime/executive/cell.hpp"
#include "runtime/realtime/thread_setup.hpp"

namespace flexrf {

/// What stands in the last lines of a terminal while the application runs. All functions: the thread that
/// makes it.
class TerminalView {
 public:
  virtual ~TerminalView() = default;
  /// In every turn of the thread; it leaves out what would be too often.
  virtual void draw(Time now) = 0;
};
/// Null: there is no terminal for it.
using MakeView = std::unique_ptr<TerminalView> (*)(Cell& cell);

/// A thread that writes the log, the view and at the end the report. It may wait for a reader that is
/// slow, stopped or stuck, so that nobody who supervises does. All functions: one thread, not real-time.
class OutputThread {
 public:
  explicit OutputThread(Cell& cell) : cell_(&cell) {}
  OutputThread(const OutputThread&) = delete;
  OutputThread& operator=(const OutputThread&) = delete;
  /// Waits for the thread: not while is_ending() is true, which only leaving the process ends then.
  ~OutputThread();

  /// Before start(); without it there is no view.
  void set_view(MakeView make) noexcept { make_view_ = make; }
  Status start() noexcept;
  /// In every turn of the supervising thread: where the log's reader is stuck, the log goes to the panel all
  /// the same. Never waits.
  void observe() noexcept;

  /// What was logged so far is formatted, for who looks at it afterwards (logged_warnings()). Waits for the
  /// thread, not for its reader.
  void catch_up() noexcept;

  /// Takes the view away, then writes the rest of the log and these texts on standard output. Once;
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
  MakeView make_view_ = nullptr;
  std::atomic<bool> ends_{false};
  std::atomic<bool> ended_{false};
  std::atomic<std::uint32_t> turns_{0};
  std::vector<std::string> texts_;
  Status failure_;
  RunningThread thread_;
};

}  // namespace flexrf
