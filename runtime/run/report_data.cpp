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
bool hangs(const ThreadRecord& thread, const ThreadState& state, Time now) noexcept {
  const std::int64_t began = state.step_began.load();
  return began != 0 && now - Time{Duration{began}} > Supervision::hang_timeout(thread);
}

std::vector<ThreadReport> collect_threads(const Application& application, const Statistics& statistics,
                                          const RunSummary& summary) {
  const std::vector<std::optional<Duration>> responses = response_estimates(application, summary.realtime);
  std::vector<ThreadReport> threads;
  for (std::size_t i = 0; i < application.threads.size(); ++i) {
    ThreadReport& thread = threads.emplace_back(ThreadReport{statistics.thread(i), false, responses[i]});
    thread.hangs =
        summary.stuck && hangs(*thread.record, application.thread_states[i], MonotonicClock::now());
  }
  return threads;
}

template <class Records>
std::vector<ComponentFigures> collect(const Statistics& statistics, const Records& records) {
  std::vector<ComponentFigures> components;
  for (const ComponentRecord& record : records) components.push_back(statistics.component(record.index));
  return components;
}

std::string name_of_signal(int signal) {
  const char* name = sigabbrev_np(signal);
  return name == nullptr ? "signal " + std::to_string(signal) : "SIG" + std::string{name};
}

/// What to blame first: a component in fault, a thread that hangs, one that was restarted.
std::string blame(const ReportData& data) {
  if (!data.summary.start_failure) return std::string{"not started: "} + data.summary.start_failure.cause();
  for (const auto* components : {&data.devices, &data.units}) {
    for (const ComponentFigures& component : *components) {
      if (!component.fault) return std::string{component.record->name} + ": " + component.fault.cause();
    }
  }
  for (const ThreadReport& thread : data.threads) {
    if (thread.hangs) return "thread " + std::string{thread.record->name} + ": its step does not return";
  }
  for (std::size_t place = data.fault_places.thread(0); place < data.fault_places.count(); ++place) {
    if (data.fault_places.extent(place) == 0) continue;
    const FaultPlaces::Fault fault = data.fault_places.at(place);
    if (place == data.fault_places.process()) return "the process " + fault.cause;
    return std::string{fault.kind} + " " + fault.name + " " + fault.cause;
  }
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
      fault_places(cell),
      threads(collect_threads(*application, statistics, summary)),
      units(collect(statistics, application->units)),
      devices(collect(statistics, application->devices)),
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
