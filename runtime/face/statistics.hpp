// What is counted and measured of components, threads, slots and queues, and what is in fault.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "runtime/executive/cell.hpp"
#include "runtime/face/slot_readers.hpp"

namespace flexrf {

struct ComponentFigures {
  const ComponentRecord* record;
  const ComponentType* type;
  const char* driver;  ///< name of the chosen one; "": it has none
  Life life;
  Status fault;  ///< the cause while it is in fault, else ok
  bool active;
  Restraint restraint;       ///< why it does less than it was commanded now
  std::uint64_t restraints;  ///< how often that was so
  std::uint64_t steps;
  Duration execution_mean;
  Duration execution_maximum;
};

struct ThreadFigures {
  const ThreadRecord* record;
  std::uint64_t cycles;
  std::uint64_t overruns;
  std::uint64_t skipped;
  Duration skipped_time;
  Duration longest_standstill;
  std::uint64_t allocations;
  const Histogram* lateness;
  const Histogram* execution;
  // What the kernel counted from the thread's first wait to its end; nothing before that.
  std::uint64_t minor_faults;
  std::uint64_t major_faults;
  std::uint64_t voluntary_switches;
  std::uint64_t involuntary_switches;
};

struct QueueWriterFigures {
  const char* name;
  QueueCounters counters;
};

/// Any thread that is not real-time. Nothing but the constructor allocates.
class Statistics {
 public:
  /// When everything is constructed.
  explicit Statistics(const Cell& cell) : cell_(&cell), readers_(readers_of_slots(cell.application())) {}

  ComponentFigures component(ComponentIndex component) const noexcept;
  ThreadFigures thread(std::size_t thread) const noexcept;
  std::span<const SlotInput> readers(std::size_t slot) const noexcept { return readers_[slot]; }
  InputCounters counters(const SlotInput& reader) const noexcept {
    return reader.counters(cell_->application());
  }
  static QueueWriterFigures writer(const QueueRecord& queue, std::size_t writer) noexcept;

 private:
  const Cell* cell_;
  std::vector<std::vector<SlotInput>> readers_;
};

/// The longest response of each thread, estimated from declared budgets; Duration::max(): there is no bound.
/// None where that cannot be said, and for all while not `realtime`: ordinary threads are promised nothing,
/// simulated ones disturb nobody.
std::vector<std::optional<Duration>> response_estimates(const Application& application, bool realtime);

/// All that can be in fault, each in its place: components by their index, threads by theirs, the process.
/// Any thread that is not real-time.
class FaultPlaces {
 public:
  struct Fault {
    const char* kind;  ///< "unit", "device", "thread", "process"
    const char* name;
    std::string cause;
  };

  explicit FaultPlaces(const Cell& cell) noexcept : cell_(&cell) {}

  std::size_t count() const noexcept { return process() + 1; }
  std::size_t thread(std::size_t thread) const noexcept { return cell_->component_count() + thread; }
  std::size_t process() const noexcept { return thread(cell_->application().threads.size()); }

  /// 0: there is no fault. Of what stood still the longest time, in ns: one that was longer is a new fault.
  std::int64_t extent(std::size_t place) const noexcept;
  /// Of one with an extent.
  Fault at(std::size_t place) const;

 private:
  const Cell* cell_;
};

}  // namespace flexrf
