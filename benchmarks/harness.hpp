// What the benchmarks share: alternating blocks of ours and a floor, intervals, a report as text and JSON.
//
// The machine is noisy and may be shared: nothing is judged by one run. Blocks are short and alternate, each
// pair gives one ratio, and the median of the ratios stands with a bootstrap interval. A goal is met when the
// interval's end on its side is. A figure is never a test's pass mark.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/time.hpp"

namespace flexrf::bench {

/// A median with its 95 % interval (percentile bootstrap, 2000 resamplings, fixed seed).
struct Estimate {
  double median = 0;
  double low = 0;
  double high = 0;
};
Estimate estimate(std::span<const double> values);
/// The value below or at which a share of all lies; sorts. 0 for none.
double quantile(std::vector<double>& values, double share);

/// Ours and the floor, block by block.
class Pairs {
 public:
  void add(double ours, double floor) {
    ours_.push_back(ours);
    floor_.push_back(floor);
    ratios_.push_back(ours / floor);
  }
  Estimate ours() const { return estimate(ours_); }
  Estimate floor() const { return estimate(floor_); }
  Estimate ratio() const { return estimate(ratios_); }

 private:
  std::vector<double> ours_;
  std::vector<double> floor_;
  std::vector<double> ratios_;
};

/// Runs `blocks` blocks of each, alternating, and now this one first and now the other. Each callable runs
/// one block and returns its figure.
template <class Ours, class Floor>
Pairs alternate(int blocks, Ours&& run_ours, Floor&& run_floor) {
  Pairs pairs;
  for (int block = 0; block < blocks; ++block) {
    if (block % 2 == 0) {
      const double ours = run_ours();
      pairs.add(ours, run_floor());
    } else {
      const double floor = run_floor();
      pairs.add(run_ours(), floor);
    }
  }
  return pairs;
}

/// Nanoseconds per call over one block of so many calls.
template <class Call>
double nanoseconds_per_call(std::uint64_t calls, Call&& call) {
  const Time begin = MonotonicClock::now();
  for (std::uint64_t i = 0; i < calls; ++i) call();
  return static_cast<double>((MonotonicClock::now() - begin).count()) / static_cast<double>(calls);
}

/// How many calls make a block of about this length.
template <class Call>
std::uint64_t calls_in(Duration length, Call&& call) {
  std::uint64_t calls = 1;
  for (;;) {
    const double each = nanoseconds_per_call(calls, call);
    const double all = each * static_cast<double>(calls);
    if (all * 4 >= static_cast<double>(length.count())) {
      const double wanted = static_cast<double>(length.count()) / each;
      return wanted < 1 ? 1 : static_cast<std::uint64_t>(wanted);
    }
    calls *= 2;
  }
}

/// The compiler must assume that the memory is read and written here.
inline void touch(const void* memory) {
  asm volatile("" : : "r"(memory) : "memory");
}

/// Pins the calling thread (cpu < 0: does not) and gives it SCHED_FIFO at this priority (0: does not). False,
/// and said once in the report's head, when the right is missing.
bool settle_thread(int cpu, int priority);
/// Back to an ordinary thread: what it starts from now on is ordinary too, but still pinned.
void leave_real_time();

/// While it lives the processors stay out of idle states that take long to leave, as far as the right is
/// there.
class NoDeepIdle {
 public:
  NoDeepIdle();
  NoDeepIdle(const NoDeepIdle&) = delete;
  NoDeepIdle& operator=(const NoDeepIdle&) = delete;
  ~NoDeepIdle();

 private:
  int descriptor_;
};

/// What was measured, and against which goal.
struct Row {
  std::string what;
  std::string unit;  ///< "ns", "" for a ratio
  Estimate value;    ///< low = high = median where there is no interval
  double goal = 0;   ///< at most this; with has_goal
  bool has_goal = false;
  std::string note;       ///< floor, multiples, conditions
  bool at_least = false;  ///< the goal is a least
  std::string ours{};     ///< of a ratio: the two medians, with unit
  std::string floor{};
};

enum class Goal { at_most, at_least };

/// Command line, text on standard output, JSON on request.
///
///   --quick        shorter blocks and fewer of them: to see that it works
///   --json FILE    the same as JSON
class Report {
 public:
  /// Ends the process with 1 when the command line makes no sense.
  Report(const char* name, int argument_count, char** arguments);

  bool is_quick() const { return quick_; }
  /// `full` unless --quick was given.
  template <class Value>
  Value choose(Value full, Value quick) const {
    return quick_ ? quick : full;
  }

  void add(Row row);
  void add_ratio(std::string what, const Pairs& pairs, double goal, const char* unit,
                 const std::string& note = "", Goal kind = Goal::at_most);
  /// A line below the table: what no row can hold, as each failure with its cause.
  void remark(std::string line) { remarks_.push_back(std::move(line)); }
  /// Prints everything, writes the JSON; the process's exit code: 0, or 1 when the file could not be written.
  int finish();

 private:
  std::string name_;
  std::string json_file_;
  bool quick_ = false;
  std::vector<Row> rows_;
  std::vector<std::string> remarks_;
};

/// printf into a string.
[[gnu::format(printf, 1, 2)]] std::string text(const char* format, ...);

}  // namespace flexrf::bench
