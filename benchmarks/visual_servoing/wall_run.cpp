// The cell by the wall clock: `servoing_wall FILE BLOCKS SECONDS` writes as JSON, block by block, what its
// threads used, how many pictures were seen, how late the arm heard of each, how recognition found its jobs,
// and what was allocated.
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

#include "benchmarks/harness.hpp"
#include "benchmarks/visual_servoing/first_look.hpp"
#include "benchmarks/visual_servoing/thread_allocations.hpp"
#include "benchmarks/visual_servoing/wall_cell.hpp"
#include "part_picker_unit.hpp"
#include "recognition_unit.hpp"
#include "types/track_list.hpp"
#include "visual_features_unit.hpp"

namespace flexrf::bench {
namespace {

using Json = nlohmann::ordered_json;

// Before the first block: the arm surveys, and what is built once is built.
constexpr double warming_up = 4;  // s
// The picker tells of another picture every 33 ms at most.
constexpr double look_each = 0.002;  // s
constexpr int looks_between_traces = 50;

/// Whoever takes part in a picture.
constexpr struct {
  const char* part;
  std::initializer_list<const char*> threads;
} parts[] = {{"render", {"camera"}},
             {"features", {"features"}},
             {"attention", {"attention"}},
             {"recognition", {"recognition", "tracks"}}};

/// Of all CPUs together since the start, in s: a virtual machine's CPUs had work, and the host gave its own
/// to others.
double stolen_time() {
  std::ifstream file("/proc/stat");
  std::string name;
  double ticks = 0;
  file >> name;
  for (int i = 0; i < 8; ++i) file >> ticks;  // user, nice, system, idle, iowait, irq, softirq, steal
  return ticks / static_cast<double>(sysconf(_SC_CLK_TCK));
}

struct Counted {
  Time at;
  std::vector<double> part_seconds;
  std::uint64_t pictures = 0;
  std::uint64_t found = 0;  // steps of recognition with a verdict
  std::uint64_t polls = 0;
};

class Measurement {
 public:
  explicit Measurement(WallCell& cell)
      : cell_(cell), picker_(cell.slot("picker.feedback")), tracks_(cell.slot("tracks")) {
    for (const ThreadRecord& thread : cell.application().threads) names_.push_back(thread.name);
    count_allocations_of(names_);
  }

  void run(int blocks, double seconds) {
    settle_thread(-1, 1);  // what it measures is a millisecond old at most, whatever else has to be done
    pause(warming_up);
    const double stolen = stolen_time();
    const Time began = MonotonicClock::now();
    std::vector<std::uint64_t> allocations;
    for (std::size_t i = 0; i < names_.size(); ++i) allocations.push_back(allocations_of(i));
    FirstLook first_look(cell_);
    for (int block = 0; block < blocks; ++block) measure_block(seconds, first_look);
    for (std::size_t i = 0; i < names_.size(); ++i)
      allocations_[names_[i]] = allocations_of(i) - allocations[i];
    const double all_cpus = flexrf::seconds(MonotonicClock::now() - began) *
                            static_cast<double>(std::thread::hardware_concurrency());
    stolen_share_ = (stolen_time() - stolen) / all_cpus;
  }

  /// After the application ended.
  Json result() const {
    const std::size_t control = cell_.threads("control").front();
    Json result{{"realtime", cell_.is_realtime()}, {"blocks", blocks_}, {"allocations", allocations_}};
    result["control_execution_p99_us"] = seconds(cell_.state(control).execution.quantile(0.99)) * 1e6;
    const auto& features = *static_cast<const user::FeatureExtractionFeedback*>(feedback("features"));
    result["missed_pictures"] = features.missed;
    std::uint64_t done = 0;
    std::uint64_t repeated = 0;
    std::uint64_t outdated = 0;
    for (const UnitRecord& unit : cell_.application().units) {
      if (!std::string_view{unit.name}.starts_with("recognition")) continue;
      const auto& told = *static_cast<const user::RecognitionFeedback*>(feedback(unit.name));
      done += told.done;
      repeated += told.repeated;
      outdated += told.outdated;
    }
    result["regions"] = done;
    result["repeated_regions"] = repeated;
    result["outdated_regions"] = outdated;
    const Counted all = count();
    result["polls"] = all.polls;
    result["polls_that_found"] = all.found;
    const auto& picker = *static_cast<const user::PartPickerFeedback*>(feedback("picker"));
    result["approaches"] = picker.approaches;
    result["stolen_share"] = stolen_share_;
    result["binned"] = picker.binned;
    return result;
  }

 private:
  const void* feedback(const char* unit) const {
    return cell_.executive().cell().component(cell_.unit(unit)).parameter_memory().feedback;
  }

  Counted count() const {
    Counted counted;
    counted.at = MonotonicClock::now();
    for (const auto& part : parts) {
      Duration sum{};
      for (const char* const thread : part.threads) sum += cell_.cpu_time(thread);
      counted.part_seconds.push_back(seconds(sum));
    }
    counted.pictures = cell_.slot("features").control->published();
    counted.found = cell_.published("verdicts[");
    for (const std::size_t thread : cell_.threads("recognition")) {
      const std::uint64_t releases = cell_.state(thread).cycles;
      // A release takes two turns of the thread, it and the wait after it; each other turn of a thread that
      // polls is a poll that found nothing.
      const std::uint64_t turns = cell_.state(thread).turns;
      const bool polls = cell_.record(thread).trigger.kind == TriggerKind::backoff;
      counted.polls += polls && turns > 2 * releases ? turns - releases : releases;
    }
    return counted;
  }

  void measure_block(double length, FirstLook& first_look) {
    const Counted before = count();
    std::vector<double> latencies;
    tracked_pictures_ = 0;
    for (int looks = 0; MonotonicClock::now() - before.at < duration_of(length); ++looks) {
      pause(look_each);
      look(latencies);
      if (looks % looks_between_traces == 0) first_look.collect();
    }
    const Counted after = count();
    const auto pictures = static_cast<double>(after.pictures - before.pictures);
    Json block{{"seconds", seconds(after.at - before.at)},
               {"pictures", after.pictures - before.pictures},
               {"tracked_pictures", tracked_pictures_}};
    for (std::size_t i = 0; i < std::size(parts); ++i)
      block[parts[i].part] = 1e3 * (after.part_seconds[i] - before.part_seconds[i]) / pictures;
    block["latencies_ms"] = latencies;
    block["first_looks_us"] = first_look.waits();
    blocks_.push_back(block);
  }

  void look(std::vector<double>& latencies) {
    // Of a picture there are several lists: each verdict may change it.
    user::TrackList list;
    if (cell_.newest(tracks_, list) && list.frame != tracked_) {
      tracked_ = list.frame;
      ++tracked_pictures_;
    }
    user::PartPickerFeedback told;
    if (!cell_.newest(picker_, told)) return;
    const Time now = MonotonicClock::now();
    if (told.approaches != approaches_) began_ = now;
    approaches_ = told.approaches;
    if (told.latency == latency_) return;
    latency_ = told.latency;
    // The way to another part begins by what was seen of it before, however long ago.
    if (now - duration_of(told.latency) > began_) latencies.push_back(told.latency * 1e3);
  }

  WallCell& cell_;
  const SlotRecord& picker_;
  const SlotRecord& tracks_;
  std::vector<const char*> names_;
  Json blocks_ = Json::array();
  Json allocations_ = Json::object();
  double stolen_share_ = 0;
  std::uint64_t tracked_ = 0;  // the picture that the newest list of tracks is of
  std::uint64_t tracked_pictures_ = 0;
  double latency_ = 0;
  std::uint64_t approaches_ = 0;
  Time began_{};  // the approach under way
};

int run(const char* file, int blocks, double seconds) {
  WallCell cell;
  Measurement measurement(cell);
  if (!cell.run([&] { measurement.run(blocks, seconds); })) return 1;
  std::ofstream(file) << measurement.result().dump(1) << '\n';
  return 0;
}

}  // namespace
}  // namespace flexrf::bench

int main(int count, char** arguments) {
  if (count == 4)
    return flexrf::bench::run(arguments[1], std::atoi(arguments[2]), std::strtod(arguments[3], nullptr));
  std::fprintf(stderr, "servoing_wall FILE BLOCKS SECONDS\n");
  return 1;
}
