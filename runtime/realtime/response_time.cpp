#include "runtime/realtime/response_time.hpp"

#include <cstdio>
#include <optional>
#include <vector>

#include "base/response_time.hpp"

namespace flexrf {

using Task = ResponseTimeTask;

bool analyse_response_times(std::span<const Task> tasks, std::span<ResponseTimeResult> results) noexcept {
  std::vector<PeriodicTask> periodic;
  periodic.reserve(tasks.size());
  for (const Task& task : tasks)
    periodic.push_back(
        {task.cpu, task.priority, task.execution.count(), task.period.count(), task.jitter.count()});
  ResponseTimeAnalysis analysis(periodic);
  bool all = true;
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    const std::optional<std::int64_t> response = analysis.longest_response(i);
    results[i].response = response ? Duration{*response} : Duration::max();
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
