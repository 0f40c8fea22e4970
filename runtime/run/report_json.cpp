// The final report for programs.
#include "base/json_writer.hpp"
#include "base/quantity_text.hpp"
#include "runtime/core/value_json.hpp"
#include "runtime/face/json_parts.hpp"
#include "runtime/realtime/response_time.hpp"
#include "runtime/run/report.hpp"
#include "runtime/run/report_data.hpp"

namespace flexrf {
namespace {

void write_run(JsonWriter& json, const ReportData& data) {
  const RunSummary& summary = data.summary;
  json.key("run").begin_object();
  json.member("ending", data.ending).member("cause", name_of(summary.cause));
  json.member("signal", summary.signal).member("exit_code", summary.exit_code);
  json.member("fault", summary.had_fault)
      .member("cut_short", summary.cut_short)
      .member("stuck", summary.stuck)
      .member("not_saved", summary.save_failure.cause())
      .member("configuration_writings", summary.writings);
  json.member("virtual_time", summary.virtual_time).member("realtime", summary.realtime);
  json.member("run_time_ns", summary.run_time.count()).member("wall_time_ns", summary.wall_time.count());
  json.member("start_time_ns", summary.start_time.count());
  json.key("digest");
  summary.digest ? json.value(hexadecimal_text(*summary.digest)) : json.null();
  json.end_object();
}

void write_threads(JsonWriter& json, const ReportData& data) {
  json.key("threads").begin_array();
  for (const ThreadReport& thread : data.threads) {
    json.begin_object();
    write_thread(json, thread);
    json.key("response_estimate_ns");
    const Duration response = thread.response_estimate.value_or(Duration::max());
    response == Duration::max() ? json.null() : json.value(response.count());
    json.member("allocations", thread.allocations).member("minor_faults", thread.minor_faults);
    json.member("major_faults", thread.major_faults).member("voluntary_switches", thread.voluntary_switches);
    json.member("involuntary_switches", thread.involuntary_switches)
        .member("hangs", thread.hangs)
        .end_object();
  }
  json.end_array().member("response_estimate_meaning", response_time_label);
}

void write_end(JsonWriter& json, const ComponentFigures& component) {
  json.member("restraints", component.restraints).key("fault");
  component.fault ? json.null() : json.value(component.fault.cause());
  json.end_object();
}

void write_components(JsonWriter& json, const ReportData& data) {
  json.key("units").begin_array();
  for (const ComponentFigures& unit : data.statistics.units()) {
    json.begin_object().member("name", unit.record->name).member("life", name_of(unit.life));
    json.member("active", unit.active).member("steps", unit.steps);
    json.member("budget_ns", unit.record->budget.count());
    json.member("execution_mean_ns", unit.execution_mean.count());
    json.member("execution_max_ns", unit.execution_maximum.count());
    json.member("budget_overruns", unit.budget_overruns);
    write_end(json, unit);
  }
  json.end_array().key("devices").begin_array();
  for (const DeviceFigures& device : data.statistics.devices()) {
    json.begin_object().member("name", device.record->name).member("driver", device.driver);
    json.member("life", name_of(device.life));
    write_end(json, device);
  }
  json.end_array();
}

/// Beyond this a value is of no use in a report.
constexpr std::uint32_t largest_value = 4096;

/// What the slot held at the end, whatever became of its writer; null: nothing, not observed, or too large.
void write_last_value(JsonWriter& json, ObservedSlots& slots, const SlotFigures& slot) {
  json.key("last");
  const ObservedSlot* const newest =
      slot.type->is_image || slot.type->size > largest_value ? nullptr : &slots.read(slot.index);
  if (newest == nullptr || newest->last == nullptr) {
    json.null();
    return;
  }
  json.begin_object().member("sequence", newest->header.sequence);
  json.member("time_ns", nanoseconds(newest->header.sampled_at)).key("value");
  write_value(json, *slot.type, newest->last);
  json.end_object();
}

void write_slots(JsonWriter& json, const ReportData& data, const Cell& cell) {
  ObservedSlots newest(cell);
  json.key("slots").begin_array();
  for (const SlotFigures& slot : data.statistics.slots()) {
    json.begin_object().member("name", slot.record->name).member("writer", slot.record->writer);
    json.member("type", slot.type->name).member("published", slot.published);
    write_last_value(json, newest, slot);
    write_readers(json, slot);
    json.end_object();
  }
  json.end_array();
}

void write_queues(JsonWriter& json, const ReportData& data) {
  json.key("queues").begin_array();
  for (const QueueFigures& queue : data.statistics.queues()) {
    json.begin_object().member("name", queue.record->name).member("type", queue.record->type->name);
    write_queue(json, queue);
    json.end_object();
  }
  json.end_array();
}

void write_memory(JsonWriter& json, const ReportData& data) {
  json.key("memory").begin_object().member("budget_bytes", data.application->memory_budget);
  if (data.process) {
    json.member("resident_peak_bytes", data.process->resident_peak)
        .member("locked_bytes", data.process->locked);
  }
  json.member("allocation_guard", data.guarded).end_object();
}

}  // namespace

std::string report_json(const Cell& cell, const RunSummary& summary) {
  const ReportData data(cell, summary);
  JsonWriter json;
  json.begin_object().member("application", data.application->name);
  json.member("descriptor_hash", hexadecimal_text(data.application->descriptor_hash));
  write_run(json, data);
  write_threads(json, data);
  write_components(json, data);
  write_slots(json, data, cell);
  write_queues(json, data);
  write_memory(json, data);
  json.member("faults", data.faults).member("dropped_log_messages", data.dropped_log_messages);
  json.member("longest_standstill_ns", data.longest_standstill.count());
  json.member("unwritten_log_lines", data.unwritten_log_lines);
  json.member("warnings", data.warnings.count).key("first_warnings").begin_array();
  for (const std::string& line : data.warnings.first) {
    if (!line.empty()) json.value(line.c_str());
  }
  json.end_array();
  return json.end_object().take();
}

}  // namespace flexrf
