#include "runtime/face/json_parts.hpp"

#include <array>
#include <utility>

#include "runtime/core/value_json.hpp"

namespace flexrf {

void write_quantiles(JsonWriter& json, const Histogram& histogram) {
  json.member("count", histogram.count());
  json.member("p50_ns", histogram.quantile(0.5).count()).member("p99_ns", histogram.quantile(0.99).count());
  json.member("p99.9_ns", histogram.quantile(0.999).count()).member("max_ns", histogram.maximum().count());
}

void write_cycles(JsonWriter& json, const ThreadFigures& thread) {
  json.member("cycles", thread.cycles).member("overruns", thread.overruns);
  json.member("skipped", thread.skipped).member("skipped_time_ns", thread.skipped_time.count());
  json.member("longest_standstill_ns", thread.longest_standstill.count());
}

void write_backoff(JsonWriter& json, const ThreadFigures& thread) {
  json.key("backoff");
  if (thread.record->trigger.kind != TriggerKind::backoff) {
    json.null();
    return;
  }
  json.begin_object().member("mean_ns", thread.backoff_mean.count());
  json.member("spread_ns", thread.backoff_spread.count()).end_object();
}

void write_thread(JsonWriter& json, const ThreadFigures& thread) {
  json.member("name", thread.record->name).member("priority", thread.record->priority);
  write_cycles(json, thread);
  for (const auto& [name, measured] :
       {std::pair{"lateness", thread.lateness}, std::pair{"execution", thread.execution}}) {
    json.key(name).begin_object();
    write_quantiles(json, *measured);
    json.end_object();
  }
  write_backoff(json, thread);
  json.member("budget_ns", thread.record->budget.count());
  json.member("deadline_ns", thread.record->deadline.count());
}

void write_readers(JsonWriter& json, const SlotFigures& slot) {
  json.key("readers").begin_array();
  for (const SlotInput& reader : slot.readers) {
    const InputCounters counters = reader.counters();
    json.begin_object().member("name", reader.name).member("read", counters.read);
    json.member("missed", counters.missed).end_object();
  }
  json.end_array();
}

void write_queue(JsonWriter& json, const QueueFigures& queue) {
  json.member("capacity", queue.record->capacity).member("fill", queue.fill);
  if (queue.is_by_score()) {
    std::array<double, most_scores> scores{};
    const std::uint32_t count = queue.scores(scores);
    json.key("scores").begin_array();
    for (std::uint32_t i = 0; i < count; ++i) json.value(scores[i]);
    json.end_array();
  }
  json.key("writers").begin_array();
  for (std::size_t i = 0; i < queue.writer_count(); ++i) {
    const auto [name, counters] = queue.writer(i);
    json.begin_object().member("name", name).member("pushed", counters.pushed);
    json.member("popped", counters.popped).member("dropped", counters.dropped).end_object();
  }
  json.end_array().key("readers").begin_array();
  for (const char* const reader : queue.record->readers) json.value(reader);
  json.end_array();
}

void write_observed(JsonWriter& json, const TypeDescriptor& type, const ObservedSlot& newest,
                    std::string_view reason) {
  json.member("reason", reason);
  json.member("sequence", newest.header.sequence);
  json.member("sampled_at_ns", nanoseconds(newest.header.sampled_at)).key("value");
  if (newest.value == nullptr) {
    json.null();
  } else {
    write_value(json, type, newest.value);
  }
}

}  // namespace flexrf
