#include "runtime/realtime/response_time.hpp"

#include <algorithm>
#include <cstdio>

namespace flexrf {

namespace {

using Task = ResponseTimeTask;

bool disturbs(const Task& other, const Task& task) noexcept {
  return &other != &task && other.cpu == task.cpu && other.priority >= task.priority;
}

/// Execution that `task` may ask for in a window: releases in it, the first as late as its jitter allows.
std::int64_t demand(const Task& task, std::int64_t window) noexcept {
  const std::int64_t reach = window + task.jitter.count();
  return (reach + task.period.count() - 1) / task.period.count() * task.execution.count();
}

/// Whether the task and what disturbs it ask for no more than the CPU has; beyond that no response has a
/// bound.
bool has_bound(std::span<const Task> tasks, const Task& task) noexcept {
  // Rounding may call a load of exactly one too much or too little: the whole busy period is then finite but
  // for one that never ends, which `most_releases` below catches.
  double load = 0;
  for (const Task& other : tasks)
    if (&other == &task || disturbs(other, task))
      load += static_cast<double>(other.execution.count()) / static_cast<double>(other.period.count());
  return load <= 1.0 + 1e-9;
}

/// Releases of one busy period after which it is taken to have no end.
constexpr std::int64_t most_releases = 100'000;

Duration response_of(std::span<const Task> tasks, const Task& task) noexcept {
  if (!has_bound(tasks, task)) return Duration::max();
  const std::int64_t period = task.period.count();
  std::int64_t longest = 0;
  std::int64_t window = 0;
  // The release number `release` of a busy period that begins with everybody's latest possible release.
  for (std::int64_t release = 0; release < most_releases; ++release) {
    const std::int64_t own = (release + 1) * task.execution.count();
    std::int64_t next = std::max(window, own);
    do {
      window = next;
      next = own;
      for (const Task& other : tasks)
        if (disturbs(other, task)) next += demand(other, window);
    } while (next != window);
    longest = std::max(longest, window + task.jitter.count() - release * period);
    // The busy period ends before the next release comes.
    if (window + task.jitter.count() <= (release + 1) * period) return Duration{longest};
  }
  return Duration::max();
}

}  // namespace

bool analyse_response_times(std::span<const Task> tasks, std::span<ResponseTimeResult> results) noexcept {
  bool all = true;
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    results[i].response = response_of(tasks, tasks[i]);
    results[i].meets_deadline = results[i].response <= tasks[i].deadline;
    all = all && results[i].meets_deadline;
  }
  return all;
}

const char* describe_response_time(const Task& task, const ResponseTimeResult& result, char* text,
                                   std::size_t capacity) noexcept {
  const double deadline = seconds(task.deadline) * 1e3;
  const char* const verdict = result.meets_deadline ? "met" : "missed";
  if (result.response == Duration::max())
    std::snprintf(text, capacity, "%s: response without bound, deadline %.3f ms: %s (%s)", task.name,
                  deadline, verdict, response_time_label);
  else
    std::snprintf(text, capacity, "%s: response %.3f ms, deadline %.3f ms: %s (%s)", task.name,
                  seconds(result.response) * 1e3, deadline, verdict, response_time_label);
  return text;
}

}  // namespace flexrf
