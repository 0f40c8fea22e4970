// The final report for programs.
#include "runtime/core/json_writer.hpp"
#include "runtime/core/value_json.hpp"
#include "runtime/realtime/response_time.hpp"
#include "runtime/run/report.hpp"
#include "runtime/run/report_data.hpp"

namespace flexrf {
namespace {

void write_durations(JsonWriter& json, const char* name, const MeasuredDurations& measured) {
  json.key(name).begin_object();
  json.member("count", measured.count).member("p50_ns", measured.p50.count());
  json.member("p99_ns", measured.p99.count()).member("p99.9_ns", measured.p999.count());
  json.member("max_ns", measured.maximum.count()).end_object();
}

void write_run(JsonWriter& json, const ReportData& data) {
  const RunSummary& summary = data.summary;
  json.key("run").begin_object();
  json.member("ending", data.ending).member("cause", name_of(summary.cause));
  json.member("signal", summary.signal).member("exit_code", summary.exit_code);
  json.member("fault", summary.had_fault)
      .member("cut_short", summary.cut_short)
      .member("stuck", summary.stuck)
      .member("not_saved", summary.save_failure.cause());
  json.member("virtual_time", summary.virtual_time).member("realtime", summary.realtime);
  json.member("run_time_ns", summary.run_time.count()).member("wall_time_ns", summary.wall_time.count());
  json.member("start_time_ns", summary.start_time.count());
  json.key("digest");
  if (summary.digest) {
    // As text: a number of 64 bits does not survive every reader.
    char digits[20];
    std::snprintf(digits, sizeof(digits), "%016llx", static_cast<unsigned long long>(*summary.digest));
    json.value(digits);
  } else {
    json.null();
  }
  json.end_object();
}

void write_threads(JsonWriter& json, const ReportData& data) {
  json.key("threads").begin_array();
  for (const ThreadReport& thread : data.threads) {
    json.begin_object().member("name", thread.record->name).member("priority", thread.record->priority);
    json.member("cycles", thread.cycles)
        .member("overruns", thread.overruns)
        .member("skipped", thread.skipped)
        .member("skipped_time_ns", thread.skipped_time.count())
        .member("longest_standstill_ns", thread.longest_standstill.count());
    write_durations(json, "lateness", thread.lateness);
    write_durations(json, "execution", thread.execution);
    json.member("budget_ns", thread.record->budget.count());
    json.member("deadline_ns", thread.record->deadline.count());
    json.key("response_estimate_ns");
    if (thread.response_estimate && *thread.response_estimate != Duration::max()) {
      json.value(thread.response_estimate->count());
    } else {
      json.null();
    }
    json.member("allocations", thread.allocations).member("minor_faults", thread.minor_faults);
    json.member("major_faults", thread.major_faults).member("voluntary_switches", thread.voluntary_switches);
    json.member("involuntary_switches", thread.involuntary_switches)
        .member("hangs", thread.hangs)
        .end_object();
  }
  json.end_array().member("response_estimate_meaning", response_time_label);
}

void write_fault(JsonWriter& json, const std::string& fault) {
  json.key("fault");
  if (fault.empty()) {
    json.null();
  } else {
    json.value(fault);
  }
}

void write_components(JsonWriter& json, const ReportData& data) {
  json.key("units").begin_array();
  for (const ComponentReport& unit : data.units) {
    json.begin_object()
        .member("name", unit.name)
        .member("life", name_of(unit.life))
        .member("active", unit.active);
    json.member("steps", unit.steps).member("budget_ns", unit.budget.count());
    json.member("execution_mean_ns", unit.execution_mean.count());
    json.member("execution_max_ns", unit.execution_maximum.count());
    json.member("restraints", unit.restraints);
    write_fault(json, unit.fault);
    json.end_object();
  }
  json.end_array().key("devices").begin_array();
  for (const ComponentReport& device : data.devices) {
    json.begin_object().member("name", device.name).member("driver", device.driver);
    json.member("life", name_of(device.life));
    json.member("restraints", device.restraints);
    write_fault(json, device.fault);
    json.end_object();
  }
  json.end_array();
}

/// Beyond this a value is of no use in a report.
constexpr std::uint32_t largest_value = 4096;

/// What the slot held at the end, whatever became of its writer; null: nothing, not observed, or too large.
void write_last_value(JsonWriter& json, const SlotRecord& slot) {
  const TypeDescriptor& type = *slot.control->type();
  json.key("last");
  const ItemHeader* item = nullptr;
  if (slot.observer != nullptr && !type.is_image && type.size <= largest_value)
    item = slot.observer->newest();
  if (item == nullptr) {
    json.null();
    return;
  }
  json.begin_object().member("sequence", item->sequence).member("time_ns", nanoseconds(item->sampled_at));
  json.key("value");
  write_value(json, type, slot.observer->payload());
  json.end_object();
}

void write_slots(JsonWriter& json, const ReportData& data, const Cell& cell) {
  const auto lock = cell.observe();
  json.key("slots").begin_array();
  for (const SlotReport& slot : data.slots) {
    json.begin_object().member("name", slot.record->name).member("writer", slot.record->writer);
    json.member("type", slot.record->control->type()->name).member("published", slot.published);
    write_last_value(json, *slot.record);
    json.key("readers").begin_array();
    for (const SlotReaderReport& reader : slot.readers) {
      json.begin_object().member("name", reader.reader).member("read", reader.counters.read);
      json.member("missed", reader.counters.missed).end_object();
    }
    json.end_array().end_object();
  }
  json.end_array();
}

void write_queues(JsonWriter& json, const ReportData& data) {
  json.key("queues").begin_array();
  for (const QueueReport& queue : data.queues) {
    json.begin_object().member("name", queue.record->name).member("type", queue.record->type->name);
    json.member("capacity", queue.record->capacity).key("writers").begin_array();
    for (std::size_t i = 0; i < queue.writers.size(); ++i) {
      json.begin_object().member("name", i < queue.record->writers.size() ? queue.record->writers[i] : "");
      json.member("pushed", queue.writers[i].pushed).member("popped", queue.writers[i].popped);
      json.member("dropped", queue.writers[i].dropped).end_object();
    }
    json.end_array().key("readers").begin_array();
    for (const char* reader : queue.record->readers) json.value(reader);
    json.end_array().end_object();
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
  const ReportData data = collect_report(cell, summary);
  char hash[20];
  std::snprintf(hash, sizeof(hash), "%016llx",
                static_cast<unsigned long long>(data.application->descriptor_hash));
  JsonWriter json;
  json.begin_object().member("application", data.application->name).member("descriptor_hash", hash);
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
