// What is counted and measured of components, threads, slots and queues, and what is in fault.
#pragma once

#include <cstddef>
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
  const char* driver;      ///< name of the chosen one; "": it has none
  const char* population;  ///< name of the one that it is a member of; null: of none
  Life life;
  Status fault;  ///< the cause while it is in fault or waits, else ok
  bool active;
  Restraint restraint;       ///< why it does less than it was commanded now
  std::uint64_t restraints;  ///< how often that was so
  std::uint64_t steps;
  Duration execution_mean;
  Duration execution_maximum;
  std::uint64_t budget_overruns;
};

struct DeviceFigures : ComponentFigures {
  const DeviceRecord* device;
  const DriverRecord* chosen;
  const char* unit;  ///< name of the one that owns it; "": none does
  const char* bus;   ///< name of the one that carries it; "": none does
  const char* thread;
  bool inhibited;  ///< it actuates, and may not
};

struct ThreadFigures {
  const ThreadRecord* record;
  std::int32_t id;  ///< the kernel's; 0: it has not begun
  Time step_began;  ///< of the step that it is in; Time{}: it is in none
  std::uint64_t cycles;
  std::uint64_t overruns;
  std::uint64_t skipped;
  Duration skipped_time;
  Duration longest_standstill;
  std::uint64_t allocations;
  const Histogram* lateness;
  const Histogram* execution;
  // What back-off learned of the time between arrivals; 0: nothing yet, or it does not poll.
  Duration backoff_mean;
  Duration backoff_spread;
  // What the kernel counted from the thread's first wait to its end; nothing before that.
  std::uint64_t minor_faults;
  std::uint64_t major_faults;
  std::uint64_t voluntary_switches;
  std::uint64_t involuntary_switches;
};

struct SlotFigures {
  std::uint16_t index;
  const SlotRecord* record;
  const TypeDescriptor* type;
  std::uint64_t published;
  std::span<const SlotInput> readers;
};

struct QueueWriterFigures {
  const char* name;
  QueueCounters counters;
};

struct QueueFigures {
  const QueueRecord* record;
  std::uint32_t fill;  ///< items that wait in it

  std::size_t writer_count() const noexcept { return record->sinks.size(); }
  /// All readers of one queue draw from the same; null: nobody reads it.
  const QueueSource* source() const noexcept {
    return record->sources.empty() ? nullptr : record->sources[0];
  }
  bool is_by_score() const noexcept { return source() != nullptr && source()->is_by_score(); }
  /// As QueueSource::scores().
  std::uint32_t scores(std::span<double> scores) const noexcept {
    return source() == nullptr ? 0 : source()->scores(scores);
  }
  QueueWriterFigures writer(std::size_t writer) const noexcept {
    return {record->writers[writer], record->sinks[writer]->counters()};
  }
};

/// A range: what `figures` gives for each number below `count`. Not of <ranges>, whose views clang 14 does
/// not compile with the library of g++ 12.
template <class Figures>
struct FiguresOfEach {
  struct Iterator {
    const FiguresOfEach* range;
    std::size_t index;

    auto operator*() const noexcept { return range->figures(index); }
    Iterator& operator++() noexcept {
      ++index;
      return *this;
    }
    bool operator==(const Iterator&) const noexcept = default;
  };

  Iterator begin() const noexcept { return {this, 0}; }
  Iterator end() const noexcept { return {this, count}; }
  bool empty() const noexcept { return count == 0; }

  std::size_t count;
  Figures figures;
};

template <class Records, class Figures>
FiguresOfEach<Figures> figures_of_each(const Records& records, Figures figures) noexcept {
  return {records.size(), figures};
}

/// Any thread that is not real-time. Nothing but the constructor allocates.
class Statistics {
 public:
  /// When everything is constructed.
  explicit Statistics(const Cell& cell) : cell_(&cell), readers_(readers_of_slots(cell)) {}

  ComponentFigures component(ComponentIndex component) const noexcept;
  /// By its number among the devices.
  DeviceFigures device(std::size_t device) const noexcept;
  ThreadFigures thread(std::size_t thread) const noexcept;
  SlotFigures slot(std::size_t slot) const noexcept;
  QueueFigures queue(std::size_t queue) const noexcept;

  // Ranges: all of a kind, in the order of its table, each with its figures as of when one comes to it.
  auto units() const {
    return figures_of_each(all().units, [this](std::size_t i) { return component(all().units[i].index); });
  }
  auto devices() const {
    return figures_of_each(all().devices, [this](std::size_t i) { return device(i); });
  }
  auto slots() const {
    return figures_of_each(all().slots, [this](std::size_t i) { return slot(i); });
  }
  auto queues() const {
    return figures_of_each(all().queues, [this](std::size_t i) { return queue(i); });
  }

 private:
  const Application& all() const noexcept { return cell_->application(); }

  const Cell* cell_;
  std::vector<std::vector<SlotInput>> readers_;
};

/// The longest response of each thread, estimated from declared budgets; Duration::max(): there is no bound.
/// None where that cannot be said, and for all while not `realtime`: ordinary threads are promised nothing,
/// simulated ones disturb nobody.
std::vector<std::optional<Duration>> response_estimates(const Cell& cell, bool realtime);

/// All that can be in fault, each in its place: components by their index, threads by theirs, the process.
/// Any thread that is not real-time.
class FaultPlaces {
 public:
  struct Fault {
    const char* kind;  ///< "unit", "device", "thread", "process"
    const char* name;
    std::string who;  ///< as a text names it, before a colon: "producer", "thread producing"
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
  /// Of a thread that is known to hang.
  Fault hanging(std::size_t thread) const;

 private:
  Fault of_thread(std::size_t thread, std::string cause) const;

  const Cell* cell_;
};

}  // namespace flexrf
