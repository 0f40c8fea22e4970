// The final report for people.
#include <algorithm>

#include "base/quantity_text.hpp"
#include "base/text_table.hpp"
#include "runtime/executive/virtual_time.hpp"
#include "runtime/face/directory.hpp"
#include "runtime/face/observed_slots.hpp"
#include "runtime/parameters/value_access.hpp"
#include "runtime/realtime/response_time.hpp"
#include "runtime/run/report.hpp"
#include "runtime/run/report_data.hpp"

namespace flexrf {
namespace {

constexpr std::size_t longest_cause = 100;  // characters, beyond which a table is no longer one

std::string or_nothing(std::uint64_t count) {
  return count == 0 ? "" : std::to_string(count);
}

std::string heading(const ReportData& data) {
  const RunSummary& summary = data.summary;
  std::string text = std::string{data.application->name} + ": " + duration_text(summary.run_time);
  if (summary.virtual_time) {
    text += " of virtual time in " + duration_text(summary.wall_time);
    if (summary.wall_time.count() > 0) {
      char ratio[40];
      std::snprintf(ratio, sizeof(ratio), " (%.0f times real time)",
                    summary.run_time / std::chrono::duration<double, std::nano>(summary.wall_time));
      text += ratio;
    }
  } else {
    text += summary.realtime ? ", real time" : ", without real-time priorities";
    text += ", first step after " + duration_text(summary.start_time);
  }
  return text + "\n";
}

std::string threads_text(const ReportData& data) {
  if (data.threads.empty()) return {};
  TextTable counts({"thread", "cycles", "overruns", "skipped", "left out", "page faults", "switches",
                    "preempted", "allocations"});
  TextTable lateness({"lateness", "p50", "p99", "p99.9", "max"});
  TextTable execution({"execution", "p50", "p99", "p99.9", "max", "budget", "deadline", "response*"});
  bool estimated = false;
  for (const ThreadReport& thread : data.threads) {
    const char* name = thread.record->name;
    counts.add({name, std::to_string(thread.cycles), std::to_string(thread.overruns),
                or_nothing(thread.skipped), duration_if_any(thread.skipped_time),
                or_nothing(thread.minor_faults + thread.major_faults), or_nothing(thread.voluntary_switches),
                or_nothing(thread.involuntary_switches), or_nothing(thread.allocations)});
    if (thread.cycles == 0) continue;
    const auto row = [name](const Histogram& measured) {
      return std::vector<std::string>{
          name, duration_text(measured.quantile(0.5)), duration_text(measured.quantile(0.99)),
          duration_text(measured.quantile(0.999)), duration_text(measured.maximum())};
    };
    lateness.add(row(*thread.lateness));
    std::vector<std::string> cells = row(*thread.execution);
    cells.push_back(duration_if_any(thread.record->budget));
    cells.push_back(duration_if_any(thread.record->deadline));
    if (thread.response_estimate) {
      estimated = true;
      cells.push_back(*thread.response_estimate == Duration::max()
                          ? "no bound"
                          : duration_text(*thread.response_estimate));
    }
    execution.add(std::move(cells));
  }
  std::string text = "\nThreads\n" + counts.text("  ");
  if (!lateness.is_empty()) text += "\n" + lateness.text("  ") + "\n" + execution.text("  ");
  if (estimated) text += std::string{"  * longest response: "} + response_time_label + "\n";
  if (data.summary.virtual_time) {
    std::string without;
    for (const ThreadReport& thread : data.threads) {
      if (lacks_budget(*data.application, *thread.record))
        without += (without.empty() ? "" : ", ") + std::string{thread.record->name};
    }
    text += "  Simulated: each step lasts its declared budget" +
            (without.empty() ? "" : "; without one, as in " + without + ", 1 us") + ".\n";
  }
  return text;
}

std::string life_of(const ComponentFigures& component) {
  return component.active ? name_of(component.life) : "not active";
}

std::string units_text(const ReportData& data) {
  if (data.statistics.units().empty()) return {};
  TextTable table({"unit", "<life", "steps", "mean", "max", "budget", "exceeded"});
  std::size_t idle = 0;
  for (const ComponentFigures& unit : data.statistics.units()) {
    // A population of hundreds must not hide the rest.
    if (!unit.active && unit.steps == 0 && unit.fault) {
      ++idle;
      continue;
    }
    table.add({unit.record->name, life_of(unit), std::to_string(unit.steps),
               data.summary.virtual_time ? "" : duration_text(unit.execution_mean),
               data.summary.virtual_time ? "" : duration_text(unit.execution_maximum),
               duration_if_any(unit.record->budget), or_nothing(unit.budget_overruns)});
  }
  std::string text = "\nUnits\n" + table.text("  ");
  if (idle > 0) text += "  and " + std::to_string(idle) + " members that were never active\n";
  return text;
}

std::string devices_text(const ReportData& data) {
  if (data.statistics.devices().empty()) return {};
  TextTable table({"device", "<driver", "<life", "restrained"});
  for (const DeviceFigures& device : data.statistics.devices())
    table.add({device.record->name, device.driver, life_of(device), or_nothing(device.restraints)});
  return "\nDevices\n" + table.text("  ");
}

bool is_counted(const FieldDescriptor& field) {
  const bool is_count = field.scalar == Scalar::u64;
  const bool is_time = field.scalar == Scalar::f64 && field.count == 1 && std::string_view{field.unit} == "s";
  return (is_count || is_time) && field.count <= 16;
}

/// Feedback that counts or times something, as it was published last. Members of populations are left out:
/// the JSON has theirs.
std::string counts_text(const Cell& cell) {
  TextTable table({"<component", "<count or time", "value"});
  const Directory directory(cell);
  ObservedSlots slots(cell);
  for (ComponentIndex i = 0; i < directory.component_count(); ++i) {
    const ComponentEntry& entry = directory.entry(i);
    std::string name = entry.name;
    if (entry.feedback_slot == no_index || name.ends_with(']')) continue;
    const void* const last = slots.read(entry.feedback_slot).last;
    if (last == nullptr) continue;
    for (const ParameterDescriptor& parameter : entry.type->feedback.parameters) {
      if (!is_counted(*parameter.field)) continue;
      const FieldPlace place = whole(*parameter.field);
      std::string value = text_of(place, last);
      if (parameter.field->scalar == Scalar::f64) {
        const auto time = read_number(place, last);
        if (time) value = duration_text(duration_of(*time));
      }
      table.add({std::move(name), parameter.field->name, std::move(value)});
      name.clear();
    }
  }
  return table.is_empty() ? std::string{} : "\nCounts and times\n" + table.text("  ");
}

std::string slots_text(const ReportData& data) {
  TextTable table({"slot", "published", "<writer", "<reader", "read", "missed"});
  std::uint64_t others = 0;
  for (const SlotFigures& slot : data.statistics.slots()) {
    if (*slot.record->writer == '\0') {
      ++others;
      continue;
    }
    std::vector<std::string> cells{slot.record->name, std::to_string(slot.published), slot.record->writer};
    for (const SlotInput& reader : slot.readers) {
      const InputCounters counters = reader.counters();
      cells.insert(cells.end(),
                   {reader.name, std::to_string(counters.read), std::to_string(counters.missed)});
      table.add(std::move(cells));
      cells = {"", "", ""};
    }
    if (slot.readers.empty()) table.add(std::move(cells));
  }
  if (table.is_empty()) return {};
  std::string text = "\nSlots\n" + table.text("  ");
  if (others > 0) text += "  and " + std::to_string(others) + " of parameters and feedback\n";
  return text;
}

std::string queues_text(const ReportData& data) {
  TextTable table({"queue", "capacity", "<writer", "pushed", "popped", "dropped"});
  for (const QueueFigures& queue : data.statistics.queues()) {
    std::string name = queue.record->name;
    std::string capacity = std::to_string(queue.record->capacity);
    for (std::size_t i = 0; i < queue.writer_count(); ++i) {
      const auto [writer, counters] = queue.writer(i);
      table.add({name, capacity, writer, std::to_string(counters.pushed), std::to_string(counters.popped),
                 std::to_string(counters.dropped)});
      name.clear();
      capacity.clear();
    }
  }
  return table.is_empty() ? std::string{} : "\nQueues\n" + table.text("  ");
}

std::string faults_text(const ReportData& data) {
  if (data.faults == 0 && !data.summary.had_fault) return "\nFaults: none\n";
  TextTable table({"component", "<cause"});
  for (const FaultPlaces::Fault& fault : data.found)
    table.add({fault.who, cut_text(fault.cause, longest_cause)});
  std::string text = "\nFaults: " + std::to_string(std::max<std::uint64_t>(data.faults, 1)) + " in all\n";
  return table.is_empty() ? text : text + table.text("  ");
}

std::string values_text(const ReportData& data) {
  const RunSummary& summary = data.summary;
  std::string text;
  if (summary.writings > 0)
    text += "\nConfiguration file: written " + std::to_string(summary.writings) + " times\n";
  if (!summary.save_failure)
    text += "\nValues not saved: " + std::string{summary.save_failure.cause()} + "\n";
  return text;
}

std::string memory_text(const ReportData& data) {
  std::string text = "\nMemory: " + size_text(data.application->memory_budget) +
                     " budget of the application's own (slots, queues, stacks, units, devices)\n";
  if (data.process) {
    text += "  " + size_text(data.process->resident_peak) +
            " in use at most, with the program's code, its libraries and what serves the panel\n";
  }
  if (data.process && data.process->locked > 0) {
    text += "  " + size_text(data.process->locked) +
            " of addresses locked: what of them is in use stays in memory, the rest takes none\n";
  }
  return text;
}

std::string guard_text(const ReportData& data) {
  std::uint64_t allocations = 0;
  for (const ThreadReport& thread : data.threads) allocations += thread.allocations;
  std::string text;
  if (data.guarded && !data.summary.virtual_time) {
    text += "Allocations in real-time threads: " + (allocations == 0 ? "none" : std::to_string(allocations)) +
            "\n";
  }
  if (data.dropped_log_messages > 0) {
    text += "Log messages dropped: " + std::to_string(data.dropped_log_messages) + "\n";
  }
  if (data.warnings.count > 0) {
    text += "Warnings and errors in the log: " + std::to_string(data.warnings.count) + ", the first:\n";
    for (const std::string& line : data.warnings.first) {
      if (!line.empty()) text += "  " + line + "\n";
    }
  }
  if (data.unwritten_log_lines > 0) {
    text += "Lines of the log that nobody took: " + std::to_string(data.unwritten_log_lines) + "\n";
  }
  return text;
}

}  // namespace

std::string report_text(const Cell& cell, const RunSummary& summary) {
  const ReportData data(cell, summary);
  return heading(data) + threads_text(data) + units_text(data) + devices_text(data) + counts_text(cell) +
         slots_text(data) + queues_text(data) + faults_text(data) + values_text(data) + memory_text(data) +
         guard_text(data) + "\n" + data.ending + "\n";
}

}  // namespace flexrf
