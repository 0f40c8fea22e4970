// Values and pictures over WebSockets: to many clients, and beside one that does not read.
#include <cstdio>
#include <thread>

#include "benchmarks/panel/bare_sends.hpp"
#include "benchmarks/panel/cell.hpp"
#include "benchmarks/panel/counts.hpp"
#include "benchmarks/panel/counts_file.hpp"
#include "benchmarks/panel/live_load.hpp"
#include "benchmarks/panel/rows.hpp"
#include "places.hpp"

namespace flexrf::bench {
namespace {

using namespace std::chrono_literals;

constexpr const char* block_at_50_hz = R"([{"name":"block","rate":50}])";
constexpr const char* picture_at_15_hz = R"([{"name":"picture","rate":15,"width":640}])";
constexpr const char* both = R"([{"name":"block","rate":50},{"name":"picture","rate":15,"width":640}])";

/// Until everything is warm: connections, buffers, the compressor's memory.
void warm_up(LiveLoad& load) {
  std::this_thread::sleep_for(1s);
  load.take();
}

double percent(Duration cpu_time, Duration wall_time) {
  return 100 * seconds(cpu_time) / seconds(wall_time);
}

/// Of a core, in percent, from now on for so long.
template <class CpuTime>
double share_of(CpuTime&& cpu_time, Duration length) {
  const Duration before = cpu_time();
  const Time begin = MonotonicClock::now();
  std::this_thread::sleep_for(length);
  return percent(cpu_time() - before, MonotonicClock::now() - begin);
}

}  // namespace

bool measure_values(Report& report, const Machine& machine) {
  constexpr int clients = 100;
  // A frame's head, the message's, the item's, and the value.
  constexpr std::size_t bytes = 4 + 32 + 32 + 1024;
  Cell cell{{place::panel_load}};
  if (!cell.begin()) return false;
  cell.process().pin("panel", machine.server_cpu);
  const int blocks = report.choose(20, 4);
  const Duration length = report.choose(3s, 1s);
  std::vector<double> p99;
  LiveFigures all;
  bool good = true;
  const auto run_ours = [&] {
    LiveLoad load;
    good =
        load.begin({cell.port(), cell.session(), clients, false, block_at_50_hz, 20ms, machine.load_cpu}) &&
        good;
    warm_up(load);
    const double share = share_of([&] { return cell.server_time(); }, length);
    LiveFigures figures = load.take();
    p99.push_back(quantile(figures.delivery_us, 0.99) * 1e-3);
    all.items += figures.items;
    all.lost += figures.lost;
    all.closed += figures.closed;
    return share;
  };
  const auto run_floor = [&] {
    BareSends sends;
    good = sends.begin({clients, bytes, 20ms, machine.server_cpu, machine.load_cpu}) && good;
    std::this_thread::sleep_for(200ms);
    return share_of([&] { return sends.cpu_time(); }, length);
  };
  const Pairs pairs = alternate(blocks, run_ours, run_floor);
  if (!good) return false;
  const double expected = 50.0 * clients * blocks * seconds(length);
  const std::string conditions =
      text("%d blocks of %lld s; %.1f %% of all values came, %llu frames lost, %llu connections ended",
           blocks, static_cast<long long>(length / 1s), 100 * static_cast<double>(all.items) / expected,
           static_cast<unsigned long long>(all.lost), static_cast<unsigned long long>(all.closed));
  report.add({"1 KiB at 50 Hz to 100 clients, CPU of the server", "%", pairs.ours(), 4, true, conditions});
  report.add({"  a bare loop of send(2), as many and as long", "%", pairs.floor(), 0, false, ""});
  report.add({"  the server's CPU against that loop's", "", pairs.ratio(), 0, false, ""});
  report.add({"1 KiB at 50 Hz to 100 clients, delivery, p99", "ms", estimate(p99), 2, true, conditions});
  return true;
}

bool measure_stalled_client(Report& report, const Machine& machine) {
  Cell cell{{place::panel_load}};
  if (!cell.begin()) return false;
  LiveLoad load;
  if (!load.begin({cell.port(), cell.session(), 20, true, both, {}, machine.load_cpu})) return false;
  warm_up(load);
  // Longer than the server waits for who does not read.
  const Duration length = report.choose(20s, 7s);
  std::this_thread::sleep_for(length);
  const LiveFigures figures = load.take();
  const auto lost = static_cast<double>(figures.lost + figures.closed);
  report.add({"one of 20 clients never reads: frames that the others lost",
              "",
              {lost, lost, lost},
              0,
              true,
              text("%lld s of values and pictures, %llu frames to the others",
                   static_cast<long long>(length / 1s), static_cast<unsigned long long>(figures.frames))});
  return true;
}

bool measure_pictures(Report& report, const Machine& machine) {
  constexpr int clients = 10;
  Cell cell{{place::panel_load, {}, true, place::counting_allocator}};
  if (!cell.begin()) return false;
  const CountsFile counts{cell.counts_file()};
  if (!counts) return false;
  cell.process().pin("panel", machine.server_cpu);
  cell.process().pin("panel-pictures", machine.server_cpu);
  LiveLoad load;
  if (!load.begin({cell.port(), cell.session(), clients, false, picture_at_15_hz, {}, machine.load_cpu})) {
    return false;
  }
  warm_up(load);
  std::vector<double> shares;
  const int blocks = report.choose(10, 3);
  const Duration length = report.choose(3s, 1s);
  const std::uint64_t encodings = counts->encodings;
  const std::uint64_t pictures = cell.recording().pictures;
  for (int block = 0; block < blocks; ++block) {
    shares.push_back(share_of([&] { return cell.server_time() + cell.picture_time(); }, length));
  }
  const auto made = static_cast<double>(cell.recording().pictures - pictures);
  const double each = static_cast<double>(counts->encodings - encodings) / made;
  const LiveFigures figures = load.take();
  const std::string conditions =
      text("%.0f pictures, %.1f came to each client", made, static_cast<double>(figures.items) / clients);
  // One may be under way at either end.
  report.add({"640x480 at 15 Hz to 10 clients, pictures encoded for each published",
              "",
              {each, each, each},
              1 + 1 / made,
              true,
              conditions});
  report.add({"640x480 at 15 Hz to 10 clients, CPU of server and encoder", "%", estimate(shares), 15, true,
              conditions});
  return true;
}

bool measure_allocations(Report& report, const Machine& machine) {
  Cell cell{{place::panel_load, {}, true, place::counting_allocator}};
  if (!cell.begin()) return false;
  const CountsFile counts{cell.counts_file()};
  if (!counts) return false;
  LiveLoad load;
  if (!load.begin({cell.port(), cell.session(), 20, false, both, {}, machine.load_cpu})) return false;
  for (int i = 0; i < 3; ++i) warm_up(load);
  const Duration length = report.choose(20s, 3s);
  const std::uint64_t before = counts->allocations;
  const std::uint64_t encoders_before = counts->encoders_allocations;
  std::this_thread::sleep_for(length);
  const auto made = static_cast<double>(counts->allocations - before);
  const std::uint64_t encoders = counts->encoders_allocations - encoders_before;
  report.add(
      {"allocations and releases of the panel's server in the steady state",
       "",
       {made, made, made},
       0,
       true,
       text("%lld s of values and pictures to 20 clients; the compressor of pictures in its thread: %llu",
            static_cast<long long>(length / 1s), static_cast<unsigned long long>(encoders))});
  return true;
}

}  // namespace flexrf::bench
