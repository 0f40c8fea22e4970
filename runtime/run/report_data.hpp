// Everything the final report says, collected once, for its text and its JSON.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "runtime/executive/run_summary.hpp"
#include "runtime/face/statistics.hpp"
#include "runtime/log/log.hpp"
#include "runtime/realtime/process_statistics.hpp"

namespace flexrf {

struct ThreadReport : ThreadFigures {
  bool hangs = false;  ///< its step never returned
  /// See response_estimates().
  std::optional<Duration> response_estimate;
};

struct ReportData {
  /// After the threads ended, or when one hangs. Allocates.
  ReportData(const Cell& cell, const RunSummary& run);

  const Application* application;
  RunSummary summary;
  Statistics statistics;
  std::vector<ThreadReport> threads;
  /// Of what is in fault, hangs, or stood still once; the first is to blame.
  std::vector<FaultPlaces::Fault> found;
  std::optional<ProcessStatistics> process;
  std::uint64_t faults;         ///< how often a unit or device went into fault, those restarted too
  Duration longest_standstill;  ///< of the process as a whole
  std::uint64_t dropped_log_messages;
  std::uint64_t unwritten_log_lines;
  LoggedWarnings warnings;
  bool guarded;        ///< the allocation guard was linked in
  std::string ending;  ///< one sentence: how the run ended and why
};

}  // namespace flexrf
