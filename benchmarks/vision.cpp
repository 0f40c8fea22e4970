// What a picture costs: the shared features, eight members of attention, and twelve parts that are measured
// where they are expected. The picture is drawn, with noise; a third of the parts touch.
#include <array>
#include <memory>
#include <thread>
#include <vector>

#include "benchmarks/harness.hpp"
#include "runtime/realtime/realtime_scope.hpp"
#include "units/attention/attention.hpp"
#include "units/unit_bench.hpp"
#include "units/vision/part_finder.hpp"
#include "units/vision/tests/drawn_table.hpp"
#include "units/vision/tests/light_meter.hpp"

namespace flexrf::bench {
namespace {

using namespace std::chrono_literals;
using namespace flexrf::user;

constexpr std::size_t members = 8;

struct LaidPart {
  std::size_t kind;
  OutlinePose pose;
};

std::vector<LaidPart> twelve_parts() {
  std::vector<LaidPart> parts;
  for (std::size_t i = 0; i < 8; ++i) {
    const auto column = static_cast<double>(i % 4);
    const double row = i < 4 ? 0 : 1;
    parts.push_back({i % 4, {{0.33 + 0.08 * column, -0.09 + 0.08 * row}, 0.7 * column + row}});
  }
  parts.push_back({0, {{0.35, 0.08}, 0}});
  parts.push_back({0, {{0.40, 0.085}, 0}});
  parts.push_back({1, {{0.50, 0.08}, 0}});
  parts.push_back({1, {{0.5396, 0.08}, 0}});
  return parts;
}

/// A member with its slots.
struct Member {
  UnitBench<Attention> bench;
  SlotBench<VisualFeatures> features;
  InputBinding inputs[3] = {features.input(), {}, {}};
  SlotControl* outputs[1] = {nullptr};
  std::span<QueueSink* const> queues[1] = {};
  bool good = false;

  Member() {
    UnitBinding binding;
    binding.context = &bench.context();
    binding.inputs = inputs;
    binding.outputs = outputs;
    binding.queue_outputs = queues;
    bench.unit().connect(binding);
    static_cast<AttentionConfiguration*>(bench.unit().parameter_memory().configuration)->camera =
        camera_of_tests();
    good = bench.unit().initialise().is_ok();
  }
  void look() {
    bench.unit().reset();  // the picture is new to it
    bench.step(33ms);
  }
};

Row row_of(const char* what, double goal, const std::vector<double>& measured, const char* note) {
  Row row;
  row.what = what;
  row.unit = "ns";
  row.value = estimate(measured);
  row.goal = goal;
  row.has_goal = goal > 0;
  row.note = note;
  return row;
}

int run(int argument_count, char** arguments) {
  Report report{"vision", argument_count, arguments};
  settle_thread(static_cast<int>(std::thread::hardware_concurrency()) - 1, 50);
  const auto parts = twelve_parts();
  const auto table = std::make_unique<DrawnTable>();
  for (const LaidPart& part : parts) table->put(known_parts()[part.kind], part.pose);
  const PictureView picture = table->picture(6);

  const auto extractor = std::make_unique<FeatureExtractor>();
  const auto features = std::make_unique<VisualFeatures>();
  const auto extract = [&] {
    extractor->extract(picture.pixels, picture.stride, *features);
    touch(features.get());
  };
  extract();
  std::vector<std::unique_ptr<Member>> attention;
  for (std::size_t i = 0; i < members; ++i) {
    attention.push_back(std::make_unique<Member>());
    attention.back()->features.publish(*features, attention.back()->bench.now());
    if (!attention.back()->good) {
      std::fprintf(stderr, "vision: a member of attention was not initialised\n");
      return 1;
    }
  }
  const auto attend = [&] {
    for (const auto& member : attention) member->look();
  };
  const auto finder = std::make_unique<PartFinder>();
  finder->prepare(known_parts(), known_table_colour(), 0.4);
  LightMeter light;
  light.look(picture);
  light.tell(*finder);
  std::size_t found = 0;
  const auto measure_all = [&] {
    found = 0;
    for (const LaidPart& part : parts) {
      Finding expected;
      expected.kind = static_cast<std::uint16_t>(part.kind);
      expected.pose = part.pose;
      const auto findings = finder->measure(picture, Glance::none(table->around(part.pose.position, 0.075)),
                                            {}, table->view(), expected, {});
      for (const Finding& finding : findings)
        if ((finding.pose.position - part.pose.position).norm() < 0.001) ++found;
    }
  };
  measure_all();
  if (found != parts.size()) {
    std::fprintf(stderr, "vision: %zu of %zu parts were found\n", found, parts.size());
    return 1;
  }

  const auto blocks = [&](const auto& call) {
    const std::uint64_t calls = calls_in(report.choose<Duration>(100ms, 20ms), call);
    std::vector<double> measured;
    for (int block = 0; block < report.choose(20, 5); ++block)
      measured.push_back(nanoseconds_per_call(calls, call));
    return measured;
  };
  report.add(
      row_of("Shared features of a picture", 1.5e6, blocks(extract), "640x480 to six integral images"));
  report.add(row_of("Attention, eight members, of a picture", 2.5e6, blocks(attend), "1595 windows each"));
  report.add(row_of("Twelve parts measured where they are expected", 2e6, blocks(measure_all),
                    "four of them touch another"));
  AllocationCounter allocations{0};
  {
    const RealtimeScope scope{allocations};
    extract();
    attend();
    measure_all();
  }
  const auto allocated = static_cast<double>(allocations.load());
  report.add({"Allocations of a picture",
              "",
              {allocated, allocated, allocated},
              0,
              true,
              has_allocation_guard() ? "" : "not counted: no guard in this build"});
  return report.finish();
}

}  // namespace
}  // namespace flexrf::bench

int main(int argument_count, char** arguments) {
  return flexrf::bench::run(argument_count, arguments);
}
