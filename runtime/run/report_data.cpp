#include "runtime/run/report_data.hpp"

#include <csignal>
#include <cstring>

#include "runtime/core/text_table.hpp"
#include "runtime/executive/schedulability.hpp"
#include "runtime/executive/slot_readers.hpp"
#include "runtime/executive/supervision.hpp"
#include "runtime/log/log.hpp"
#include "runtime/realtime/realtime_scope.hpp"

namespace flexrf {
namespace {

MeasuredDurations measured(const Histogram& histogram) {
  return {histogram.count(), histogram.quantile(0.5), histogram.quantile(0.99), histogram.quantile(0.999),
          histogram.maximum()};
}

/// The others are still running when the application is given up: they are in a step now and then.
bool hangs(const ThreadRecord& thread, const ThreadState& state, Time now) noexcept {
  const std::int64_t began = state.step_began.load();
  return began != 0 && now - Time{Duration{began}} > Supervision::hang_timeout(thread);
}

std::vector<ThreadReport> collect_threads(const Application& application, const RunSummary& summary) {
  std::vector<ThreadReport> threads(application.threads.size());
  for (std::size_t i = 0; i < threads.size(); ++i) {
    const ThreadState& state = application.thread_states[i];
    ThreadReport& thread = threads[i];
    thread.record = &application.threads[i];
    thread.cycles = state.cycles.load();
    thread.overruns = state.overruns.load();
    thread.skipped = state.skipped.load();
    thread.skipped_time = Duration{state.skipped_time.load()};
    thread.longest_standstill = Duration{state.longest_standstill.load()};
    thread.allocations = state.allocations.load();
    thread.minor_faults = state.minor_faults.load();
    thread.major_faults = state.major_faults.load();
    thread.voluntary_switches = state.voluntary_switches.load();
    thread.involuntary_switches = state.involuntary_switches.load();
    thread.lateness = measured(state.lateness);
    thread.execution = measured(state.execution);
    thread.hangs = summary.stuck && hangs(*thread.record, state, MonotonicClock::now());
  }
  // Simulated threads disturb nobody, ordinary ones are promised nothing.
  if (!summary.realtime) return threads;
  const Result<MachineFile> machine = MachineFile::of_this_machine();
  if (!machine) return threads;
  const auto estimates = estimate_response_times(application, *machine);
  for (std::size_t i = 0; i < threads.size(); ++i) {
    if (estimates[i]) threads[i].response_estimate = estimates[i]->result.response;
  }
  return threads;
}

ComponentReport collect_component(const Cell& cell, ComponentIndex index) {
  const ComponentState& state = cell.application().component_state(index);
  ComponentReport component;
  component.name = cell.component_name(index);
  component.life = state.life.load();
  if (component.life == Life::fault) component.fault = state.fault.read().cause();
  component.restraints = state.restraint.count();
  return component;
}

std::vector<ComponentReport> collect_units(const Cell& cell) {
  const Application& application = cell.application();
  std::vector<ComponentReport> units;
  for (std::size_t i = 0; i < application.units.size(); ++i) {
    const UnitState& state = application.unit_states[i];
    ComponentReport& unit = units.emplace_back(collect_component(cell, static_cast<ComponentIndex>(i)));
    unit.active = state.active.load();
    unit.steps = state.steps.load();
    unit.budget = application.units[i].budget;
    unit.execution_maximum = Duration{state.execution_maximum.load()};
    if (unit.steps > 0)
      unit.execution_mean = Duration{state.execution_total.load() / static_cast<std::int64_t>(unit.steps)};
  }
  return units;
}

std::vector<ComponentReport> collect_devices(const Cell& cell) {
  std::vector<ComponentReport> devices;
  for (std::size_t i = 0; i < cell.application().devices.size(); ++i) {
    const auto device = static_cast<std::uint16_t>(i);
    devices.push_back(collect_component(cell, cell.application().devices[i].index));
    devices.back().driver = cell.driver(device).name;
  }
  return devices;
}

std::vector<SlotReport> collect_slots(const Application& application) {
  const std::vector<std::vector<SlotInput>> readers = readers_of_slots(application);
  std::vector<SlotReport> slots;
  for (std::size_t i = 0; i < application.slots.size(); ++i) {
    const SlotRecord& record = application.slots[i];
    SlotReport& slot = slots.emplace_back(SlotReport{&record, record.control->published(), {}});
    for (const SlotInput& input : readers[i])
      slot.readers.push_back({input.name, input.counters(application)});
  }
  return slots;
}

std::vector<QueueReport> collect_queues(const Application& application) {
  std::vector<QueueReport> queues;
  for (const QueueRecord& record : application.queues) {
    QueueReport queue{&record, {}};
    for (const QueueSink* sink : record.sinks) queue.writers.push_back(sink->counters());
    queues.push_back(std::move(queue));
  }
  return queues;
}

std::string name_of_signal(int signal) {
  const char* name = sigabbrev_np(signal);
  return name == nullptr ? "signal " + std::to_string(signal) : "SIG" + std::string{name};
}

/// What to blame first: a component in fault, a thread that hangs, one that was restarted.
std::string blame(const ReportData& data) {
  if (!data.summary.start_failure) return std::string{"not started: "} + data.summary.start_failure.cause();
  for (const auto* components : {&data.devices, &data.units}) {
    for (const ComponentReport& component : *components) {
      if (!component.fault.empty()) return std::string{component.name} + ": " + component.fault;
    }
  }
  for (const ThreadReport& thread : data.threads) {
    if (thread.hangs) return "thread " + std::string{thread.record->name} + ": its step does not return";
  }
  for (const ThreadReport& thread : data.threads) {
    if (thread.longest_standstill.count() > 0) {
      return "thread " + std::string{thread.record->name} + " stood still for " +
             duration_text(thread.longest_standstill);
    }
  }
  if (data.longest_standstill.count() > 0)
    return "the process stood still for " + duration_text(data.longest_standstill);
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

ReportData collect_report(const Cell& cell, const RunSummary& summary) {
  const Application& application = cell.application();
  ReportData data;
  data.application = &application;
  data.summary = summary;
  data.threads = collect_threads(application, summary);
  data.units = collect_units(cell);
  data.devices = collect_devices(cell);
  data.slots = collect_slots(application);
  data.queues = collect_queues(application);
  if (const Result<ProcessStatistics> process = read_process_statistics()) data.process = *process;
  data.faults = cell.control().faults();
  data.longest_standstill = cell.control().longest_standstill();
  data.unwritten_log_lines = unwritten_log_lines();
  data.warnings = logged_warnings();
  data.dropped_log_messages = dropped_log_messages();
  data.guarded = has_allocation_guard();
  data.ending = ending_of(data);
  return data;
}

}  // namespace flexrf
