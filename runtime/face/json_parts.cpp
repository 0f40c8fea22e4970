#include "runtime/face/json_parts.hpp"

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

void write_readers(JsonWriter& json, const Statistics& statistics, std::size_t slot) {
  json.key("readers").begin_array();
  for (const SlotInput& reader : statistics.readers(slot)) {
    const InputCounters counters = statistics.counters(reader);
    json.begin_object().member("name", reader.name).member("read", counters.read);
    json.member("missed", counters.missed).end_object();
  }
  json.end_array();
}

void write_queue(JsonWriter& json, const QueueRecord& queue) {
  json.member("capacity", queue.capacity).key("writers").begin_array();
  for (std::size_t i = 0; i < queue.sinks.size(); ++i) {
    const auto [name, counters] = Statistics::writer(queue, i);
    json.begin_object().member("name", name).member("pushed", counters.pushed);
    json.member("popped", counters.popped).member("dropped", counters.dropped).end_object();
  }
  json.end_array().key("readers").begin_array();
  for (const char* const reader : queue.readers) json.value(reader);
  json.end_array();
}

void write_observed(JsonWriter& json, const TypeDescriptor& type, const ObservedSlot& newest) {
  json.member("reason", newest.reason == NullReason::none ? "" : name_of(newest.reason));
  json.member("sequence", newest.header.sequence);
  json.member("sampled_at_ns", nanoseconds(newest.header.sampled_at)).key("value");
  if (newest.value == nullptr) {
    json.null();
  } else {
    write_value(json, type, newest.value);
  }
}

}  // namespace flexrf
