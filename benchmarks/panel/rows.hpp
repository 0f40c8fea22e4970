// The parts of the benchmark: each adds its rows, or says on standard error why it cannot and is false.
#pragma once

#include "base/time.hpp"
#include "benchmarks/harness.hpp"

namespace flexrf::bench {

struct Machine {
  int server_cpu = 0;  ///< what no real-time thread claims
  int load_cpu = 0;    ///< the other
};

/// requests.cpp: answers to requests, against nginx.
bool measure_requests(Report& report, const Machine& machine);
/// live.cpp: values and pictures to many clients.
bool measure_values(Report& report, const Machine& machine);
bool measure_stalled_client(Report& report, const Machine& machine);
bool measure_pictures(Report& report, const Machine& machine);
bool measure_allocations(Report& report, const Machine& machine);
/// beside.cpp: a real-time thread beside the panel.
bool measure_lateness(Report& report, const Machine& machine);
/// footprint.cpp: memory, the page's size.
bool measure_memory(Report& report);
bool measure_page(Report& report);
/// changes.cpp: from a change to its answer.
bool measure_changes(Report& report, const Machine& machine);
/// holds.cpp: what ends a motion, and how soon.
bool measure_holds(Report& report, const Machine& machine);

}  // namespace flexrf::bench
