// What the panel costs and how fast it answers, and that the real-time threads do not notice it.
#include <cstdio>

#include "benchmarks/panel/process.hpp"
#include "benchmarks/panel/rows.hpp"
#include "runtime/realtime/machine_file.hpp"

namespace flexrf::bench {
namespace {

int run(int argument_count, char** arguments) {
  Report report{"panel", argument_count, arguments};
  const Result<MachineFile> file = MachineFile::of_this_machine();
  if (!file) {
    std::fprintf(stderr, "panel: %s\n", file.status().cause());
    return 1;
  }
  if (!find_program("wrk") || !find_program("nginx")) {
    std::fputs("panel: wrk makes the requests and nginx is the peer: apt-get install wrk nginx-light\n",
               stderr);
    return 1;
  }
  const CpuSet control = file->cpus_of(CpuRole::control);
  const Machine machine{file->rest(control).lowest(), control.lowest()};
  bool good = measure_requests(report, machine);
  good = measure_values(report, machine) && good;
  good = measure_stalled_client(report, machine) && good;
  good = measure_pictures(report, machine) && good;
  good = measure_allocations(report, machine) && good;
  good = measure_lateness(report, machine) && good;
  good = measure_memory(report) && good;
  good = measure_page(report) && good;
  good = measure_changes(report, machine) && good;
  good = measure_holds(report, machine) && good;
  const int status = report.finish();
  return good ? status : 1;
}

}  // namespace
}  // namespace flexrf::bench

int main(int argument_count, char** arguments) {
  return flexrf::bench::run(argument_count, arguments);
}
