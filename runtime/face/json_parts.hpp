// Parts of JSON that several ways in write alike.
#pragma once

#include <cstddef>

#include "base/json_writer.hpp"
#include "runtime/face/observed_slots.hpp"
#include "runtime/face/statistics.hpp"

namespace flexrf {

// Each writes members of an open object.

/// "count", "p50_ns", "p99_ns", "p99.9_ns", "max_ns"
void write_quantiles(JsonWriter& json, const Histogram& histogram);
/// "cycles", "overruns", "skipped", "skipped_time_ns", "longest_standstill_ns"
void write_cycles(JsonWriter& json, const ThreadFigures& thread);
/// "backoff": {"mean_ns", "spread_ns"} of a thread that polls by back-off, else null
void write_backoff(JsonWriter& json, const ThreadFigures& thread);
/// "name", "priority", what write_cycles() writes, "lateness" and "execution" with their quantiles, what
/// write_backoff() writes, "budget_ns", "deadline_ns"
void write_thread(JsonWriter& json, const ThreadFigures& thread);
/// "readers": a list of {"name", "read", "missed"}
void write_readers(JsonWriter& json, const SlotFigures& slot);
/// Scores of a queue that are told at most: the highest.
inline constexpr std::size_t most_scores = 64;
/// "capacity", "fill", of a queue by score "scores" of what waits, the highest first; "writers": a list of
/// {"name", "pushed", "popped", "dropped"}, "readers": a list of names
void write_queue(JsonWriter& json, const QueueFigures& queue);
/// "reason", which is "" unless the slot is NULL, "sequence", "sampled_at_ns", "value"
void write_observed(JsonWriter& json, const TypeDescriptor& type, const ObservedSlot& newest,
                    std::string_view reason);

}  // namespace flexrf
