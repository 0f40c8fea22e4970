// Response-time analysis of periodic tasks under fixed priorities: what config-gen judges tables by, and the
// runtime the CPUs that a machine really has.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace flexrf {

struct PeriodicTask {
  std::uint32_t cpu = 0;       ///< tasks of different CPUs do not disturb each other
  int priority = 0;            ///< higher runs first; equal ones are counted as disturbing each other
  std::int64_t execution = 0;  ///< C: longest execution of one release, ns
  std::int64_t period = 0;     ///< T: shortest time between releases, ns, above 0
  std::int64_t jitter = 0;     ///< J: how much later than due a release may come, ns
};

/// Joseph and Pandya, "Finding response times in a real-time system", 1986; Audsley et al., "Applying new
/// scheduling theory to static priority pre-emptive scheduling", 1993; over the whole busy period (Lehoczky
/// 1990, Tindell 1994), so that deadlines beyond the period are right too.
///
/// The time that this takes is bounded: where a CPU is as good as full, its busy period may have any number
/// of releases, and a task whose response is not found in so many rounds is taken to have none.
class ResponseTimeAnalysis {
 public:
  /// The tasks outlive the object.
  explicit ResponseTimeAnalysis(std::span<const PeriodicTask> tasks)
      : tasks_(tasks), work_left_(20'000'000 + 64 * tasks.size() * tasks.size()) {}

  /// Longest time from due to completion of tasks[index], jitter included, ns. Nothing: it has no bound (the
  /// CPU is asked for more than it has), or none that was found.
  std::optional<std::int64_t> longest_response(std::size_t index) {
    const PeriodicTask& task = tasks_[index];
    others_.clear();
    for (const PeriodicTask& other : tasks_) {
      if (&other != &task && other.cpu == task.cpu && other.priority >= task.priority)
        others_.push_back(&other);
    }
    rounds_left_ = most_rounds;
    const double others_load = load_of_others();
    // Rounding may call a load of exactly one too much or too little.
    if (others_load + load_of(task) > 1.0 + 1e-9) return std::nullopt;
    std::int64_t longest = 0;
    std::int64_t window = 0;
    // The release number `release` of a busy period that begins with everybody's latest possible release.
    for (std::int64_t release = 0;; ++release) {
      const std::int64_t own = (release + 1) * task.execution;
      const std::optional<std::int64_t> end = end_of(std::max(window, own), own, others_load);
      if (!end) return std::nullopt;
      window = *end;
      longest = std::max(longest, window + task.jitter - release * task.period);
      // The busy period ends before the next release comes.
      if (window + task.jitter <= (release + 1) * task.period) return longest;
    }
  }

 private:
  static constexpr int most_rounds = 10'000;
  static constexpr std::int64_t longest_window = std::int64_t{1} << 61;

  static double load_of(const PeriodicTask& task) {
    return static_cast<double>(task.execution) / static_cast<double>(task.period);
  }
  double load_of_others() const {
    double load = 0;
    for (const PeriodicTask* const other : others_) load += load_of(*other);
    return load;
  }

  /// The smallest window that `own` and what the others ask for in it fill, from `least` on, which is not
  /// beyond it.
  std::optional<std::int64_t> end_of(std::int64_t least, std::int64_t own, double others_load) {
    std::int64_t next = std::max(least, bound_below(own, others_load));
    std::int64_t window = 0;
    do {
      if (--rounds_left_ < 0 || work_left_ < others_.size() || next > longest_window) return std::nullopt;
      work_left_ -= others_.size();
      window = next;
      next = own;
      for (const PeriodicTask* const other : others_)
        next += (window + other->jitter + other->period - 1) / other->period * other->execution;
    } while (next > window);
    return window;
  }

  /// Releases that came in parts would fill no larger a window, and theirs needs no iteration, which is slow
  /// where the load is close to one. A little less, for the sums are rounded; nothing where that is all.
  std::int64_t bound_below(std::int64_t own, double others_load) const {
    if (1 - others_load < 1e-6) return 0;
    double filled = static_cast<double>(own);
    for (const PeriodicTask* const other : others_)
      filled += static_cast<double>(other->jitter) * load_of(*other);
    const double bound = filled / (1 - others_load) * (1 - 1e-6);
    return bound < static_cast<double>(longest_window) ? static_cast<std::int64_t>(bound) : longest_window;
  }

  std::span<const PeriodicTask> tasks_;
  std::vector<const PeriodicTask*> others_;  // those of the same CPU that may run before the one in question
  int rounds_left_ = 0;
  std::size_t work_left_;
};

}  // namespace flexrf
