// StepTrace: which units a thread stepped lately, when each step began and how long it took.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "base/time.hpp"

namespace flexrf {

struct TracedStep {
  std::uint16_t unit = 0;  ///< in Application::units
  Time begin{};
  Duration took{};  ///< 0 to 2^47 ns; what is longer is told as that
};

/// The last steps of one thread, in a ring that its thread alone writes and anybody reads: no step waits for
/// a reader, and a reader takes what was not overwritten meanwhile. note(): 3 stores. No allocation.
///
/// A word of an entry is stored with release after the position before it, and loaded with acquire: a reader
/// that saw a newer word also sees how far the writer was, and leaves that entry out (as RingEntry).
class StepTrace {
 public:
  static constexpr std::size_t entries = 1024;
  static constexpr std::size_t most = entries - 1;  ///< that can be copied: one may just be written

  /// The thread whose steps they are.
  void note(const TracedStep& step) noexcept {
    const std::uint64_t position = written_.load(std::memory_order_relaxed);
    Entry& entry = ring_[position % entries];
    const auto took = static_cast<std::uint64_t>(step.took.count());
    entry.begin.store(step.begin.time_since_epoch().count(), std::memory_order_release);
    entry.rest.store((took < longest ? took : longest) << unit_bits | step.unit, std::memory_order_release);
    written_.store(position + 1, std::memory_order_release);
  }

  struct Copied {
    std::size_t count = 0;  ///< oldest first
    bool cut = false;       ///< there were more since `since`, which are gone or found no room
  };
  /// The newest that ended after `since`, as many as `steps` has room for. Any thread.
  Copied copy(Time since, std::span<TracedStep> steps) const noexcept;

 private:
  static constexpr int unit_bits = 16;
  static constexpr std::uint64_t longest = (std::uint64_t{1} << 47) - 1;
  struct Entry {
    std::atomic<std::int64_t> begin{0};  ///< ns
    std::atomic<std::uint64_t> rest{0};  ///< [took | unit]
  };

  std::atomic<std::uint64_t> written_{0};  ///< steps ever noted
  std::array<Entry, entries> ring_{};
};

/// Those of all threads of a cell: noted only while somebody asks, so that who does not pays a load and a
/// comparison for each release.
class StepTraces {
 public:
  explicit StepTraces(std::size_t threads) : traces_(std::make_unique<StepTrace[]>(threads)) {}

  /// Steps are noted until then. Any thread.
  void ask(Time until) noexcept { until_.store(until.time_since_epoch().count(), std::memory_order_relaxed); }
  /// For the thread itself: null while nobody asks.
  StepTrace* asked(std::size_t thread, Time now) noexcept {
    return now.time_since_epoch().count() < until_.load(std::memory_order_relaxed) ? &traces_[thread]
                                                                                   : nullptr;
  }
  const StepTrace& of(std::size_t thread) const noexcept { return traces_[thread]; }

 private:
  alignas(64) std::atomic<std::int64_t> until_{0};
  std::unique_ptr<StepTrace[]> traces_;
};

}  // namespace flexrf
