// Everything the final report says, collected once, for its text and its JSON.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "runtime/executive/cell.hpp"
#include "runtime/executive/run_summary.hpp"
#include "runtime/log/log.hpp"
#include "runtime/realtime/process_statistics.hpp"

namespace flexrf {

struct MeasuredDurations {
  std::uint64_t count = 0;
  Duration p50{};
  Duration p99{};
  Duration p999{};
  Duration maximum{};
};

struct ThreadReport {
  const ThreadRecord* record = nullptr;
  std::uint64_t cycles = 0;
  std::uint64_t overruns = 0;
  std::uint64_t skipped = 0;
  Duration skipped_time{};
  Duration longest_standstill{};
  std::uint64_t allocations = 0;
  std::uint64_t minor_faults = 0;
  std::uint64_t major_faults = 0;
  std::uint64_t voluntary_switches = 0;
  std::uint64_t involuntary_switches = 0;
  MeasuredDurations lateness;
  MeasuredDurations execution;
  bool hangs = false;  ///< its step never returned
  /// From declared budgets; none when not real-time. Duration::max(): no bound.
  std::optional<Duration> response_estimate;
};

/// A unit, or a device with its driver.
struct ComponentReport {
  const char* name = "";
  const char* driver = "";  ///< empty for a unit
  Life life = Life::created;
  bool active = true;
  std::uint64_t steps = 0;
  Duration budget{};
  Duration execution_mean{};
  Duration execution_maximum{};
  std::string fault;             ///< the cause while it is in fault, else empty
  std::uint64_t restraints = 0;  ///< how often it did less than it was commanded
};

struct SlotReaderReport {
  std::string reader;  ///< "unit.port"
  InputCounters counters;
};

struct SlotReport {
  const SlotRecord* record = nullptr;
  std::uint64_t published = 0;
  std::vector<SlotReaderReport> readers;
};

struct QueueReport {
  const QueueRecord* record = nullptr;
  std::vector<QueueCounters> writers;  ///< as record->writers
};

struct ReportData {
  const Application* application = nullptr;
  RunSummary summary;
  std::vector<ThreadReport> threads;
  std::vector<ComponentReport> units;
  std::vector<ComponentReport> devices;
  std::vector<SlotReport> slots;
  std::vector<QueueReport> queues;
  std::optional<ProcessStatistics> process;
  std::uint64_t faults = 0;       ///< how often a unit or device went into fault, those restarted too
  Duration longest_standstill{};  ///< of the process as a whole
  std::uint64_t dropped_log_messages = 0;
  std::uint64_t unwritten_log_lines = 0;
  LoggedWarnings warnings;
  bool guarded = false;  ///< the allocation guard was linked in
  std::string ending;    ///< one sentence: how the run ended and why
};

/// After the threads ended, or when one hangs. Allocates.
ReportData collect_report(const Cell& cell, const RunSummary& summary);

}  // namespace flexrf
