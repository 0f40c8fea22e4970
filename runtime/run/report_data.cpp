#include "runtime/run/report_data.hpp"

#include <csignal>
#include <cstring>

#include "base/quantity_text.hpp"
#include "runtime/executive/supervision.hpp"
#include "runtime/log/log.hpp"
#include "runtime/realtime/realtime_scope.hpp"

namespace flexrf {
namespace {

/// The others are still running when the application is given up: they are in a step now and then.
bool hangs(const ThreadFigures& thread, Time now) noexcept {
  return thread.step_began != Time{} && now - thread.step_began > Supervision::hang_timeout(*thread.record);
}

std::vector<ThreadReport> collect_threads(const Cell& cell, const Statistics& statistics,
                                          const RunSummary& summary) {
  std::vector<ThreadReport> threads;
  for (const std::optional<Duration>& response : response_estimates(cell, summary.realtime)) {
    ThreadReport& thread =
        threads.emplace_back(ThreadReport{statistics.thread(threads.size()), false, response});
    thread.hangs = summary.stuck && hangs(thread, MonotonicClock::now());
  }
  return threads;
}

/// What to blame first comes first: components, devices before what depends on them; threads that hang; what
/// stood still.
std::vector<FaultPlaces::Fault> collect_faults(const ReportData& data, const FaultPlaces& places) {
  std::vector<FaultPlaces::Fault> found;
  const auto add = [&](std::size_t place) {
    if (places.extent(place) != 0) found.push_back(places.at(place));
  };
  for (const ComponentFigures& device : data.statistics.devices()) add(device.record->index);
  for (const ComponentFigures& unit : data.statistics.units()) add(unit.record->index);
  for (std::size_t i = 0; i < data.threads.size(); ++i) {
    if (data.threads[i].hangs) found.push_back(places.hanging(i));
  }
  for (std::size_t place = places.thread(0); place < places.count(); ++place) add(place);
  return found;
}

std::string name_of_signal(int signal) {
  const char* name = sigabbrev_np(signal);
  return name == nullptr ? "signal " + std::to_string(signal) : "SIG" + std::string{name};
}

std::string blame(const ReportData& data) {
  if (!data.summary.start_failure) return std::string{"not started: "} + data.summary.start_failure.cause();
  if (!data.found.empty()) return data.found[0].who + ": " + data.found[0].cause;
  if (data.faults > 0)
    return std::to_string(data.faults) +
           (data.faults == 1 ? " fault, restarted by policy" : " faults, restarted by policy");
  return "see the log";
}

std::string ending_of(const ReportData& data) {
  const RunSummary& summary = data.summary;
  const std::string after = " after " + duration_text(summary.run_time);
  std::string how;
  switch (summary.cause) {
    case EndCause::none:
      how = "ended" + after;
      break;
    case EndCause::end_of_input:
      how = "finished: end of input" + after;
      break;
    case EndCause::virtual_time_over:
      how = "finished: the virtual time asked for is over" + after;
      break;
    case EndCause::signal:
      how = "stopped by " + name_of_signal(summary.signal) + after;
      break;
    case EndCause::requested:
      how = "stopped on request" + after;
      break;
    case EndCause::fault:
      how = "the application ended" + after;
      break;
  }
  if (summary.cut_short) how += ", before everything had come to rest in its time";
  if (summary.had_fault) return "Fault: " + blame(data) + "; " + how + ".";
  how[0] = static_cast<char>(how[0] - 'a' + 'A');
  return how + ".";
}

}  // namespace

ReportData::ReportData(const Cell& cell, const RunSummary& run)
    : application(&cell.application()),
      summary(run),
      statistics(cell),
      threads(collect_threads(cell, statistics, summary)),
      found(collect_faults(*this, FaultPlaces(cell))),
      faults(cell.control().faults()),
      longest_standstill(cell.control().longest_standstill()),
      dropped_log_messages(flexrf::dropped_log_messages()),
      unwritten_log_lines(flexrf::unwritten_log_lines()),
      warnings(logged_warnings()),
      guarded(has_allocation_guard()) {
  if (const Result<ProcessStatistics> statistics_of_it = read_process_statistics())
    process = *statistics_of_it;
  ending = ending_of(*this);
}

}  // namespace flexrf
