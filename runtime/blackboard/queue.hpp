// Queues: bounded places for items of which each goes to exactly one reader.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>

#include "runtime/blackboard/doorbell.hpp"
#include "runtime/blackboard/item.hpp"
#include "runtime/core/type_descriptor.hpp"

namespace flexrf {

enum class DropPolicy : std::uint8_t {
  drop_newest,  ///< a full queue refuses the item that comes
  drop_oldest,  ///< the reader's cursor skips what was overwritten; the writer always succeeds
};

/// Counters of one writer's way into a queue. Any thread may read them.
struct QueueCounters {
  std::uint64_t pushed = 0;   ///< accepted
  std::uint64_t popped = 0;   ///< handed to a reader
  std::uint64_t dropped = 0;  ///< refused, overwritten before they were read, or pushed out by a higher score
};

/// One writer's way into a queue. push, commit: that writer's thread.
class QueueSink {
 public:
  /// Copies the value in. False when it was dropped on the spot.
  virtual bool push(const void* value, Time sampled_at) noexcept = 0;
  /// Whether the next push would be accepted without a drop (what a polite producer asks first).
  virtual bool has_room() const noexcept = 0;
  /// Virtual time only: makes what was pushed since the last commit visible.
  virtual void commit() noexcept = 0;
  virtual void set_deferred(bool on) noexcept = 0;
  virtual void set_digested(bool on) noexcept = 0;
  virtual std::uint64_t digest() const noexcept = 0;
  virtual QueueCounters counters() const noexcept = 0;
  virtual const TypeDescriptor* type() const noexcept = 0;

 protected:
  ~QueueSink() = default;
};

/// One reader's way out of a queue. pop: that reader's thread.
class QueueSource {
 public:
  /// Copies the next item out; false when there is none.
  virtual bool pop(void* value, ItemHeader& header) noexcept = 0;
  /// How many items wait. Any thread; may be out of date at once.
  virtual std::uint32_t fill() const noexcept = 0;
  bool is_empty() const noexcept { return fill() == 0; }
  /// Whether items come out by a score.
  virtual bool is_by_score() const noexcept { return false; }
  /// Scores of items that wait, the highest first: as many as there are, or as `scores` has room for. How
  /// many that were; 0 unless is_by_score(). Any thread: reads what each writer made visible of an item's
  /// rank, writes nothing, and may be out of date at once.
  virtual std::uint32_t scores(std::span<double> /*scores*/) const noexcept { return 0; }
  /// Grows with every visible push: what a trigger compares. Any thread.
  virtual std::uint64_t arrivals() const noexcept = 0;
  /// Grows with every item that a reader took: what tells a trigger whether a step took any. Any thread.
  virtual std::uint64_t departures() const noexcept = 0;
  virtual const TypeDescriptor* type() const noexcept = 0;

 protected:
  ~QueueSource() = default;
};

}  // namespace flexrf
