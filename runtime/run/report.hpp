// The final report of a run: what was measured, for people and as JSON.
#pragma once

#include <string>

#include "runtime/executive/cell.hpp"
#include "runtime/executive/run_summary.hpp"

namespace flexrf {

/// Per thread cycles, overruns, lateness and execution p50/p99/p99.9/max against its budget, allocations,
/// page faults and switches; per slot published and read and missed by each reader; queues with drops; faults
/// with their causes; memory against its budget; dropped log messages. After the threads ended, before the
/// cell is destroyed. A thread that is not real-time.
std::string report_text(const Cell& cell, const RunSummary& summary);
/// The same as JSON (UTF-8), durations in nanoseconds, sizes in bytes; and what each observed slot,
/// parameters and feedback among them, held last.
std::string report_json(const Cell& cell, const RunSummary& summary);

}  // namespace flexrf
