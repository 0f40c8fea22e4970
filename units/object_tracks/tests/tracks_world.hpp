// The unit object_tracks with its slots, and verdicts that a test tells it.
#pragma once

#include <vector>

#include "units/object_tracks/object_tracks.hpp"
#include "units/vision/tests/drawn_table.hpp"
#include "units/vision/tests/known_parts.hpp"
#include "units/vision/tests/vision_bench.hpp"

namespace flexrf::user {

inline const Pose tool = tool_above(0.45, 0, 0.45);
inline constexpr Duration frame_period = std::chrono::milliseconds(33);

struct World {
  UnitBench<ObjectTracks> bench;
  SlotBench<VisualFeatures> features;
  RangeBench<VisionVerdicts, 2> verdicts;
  HistoryBench<Pose, 16> tool_poses;
  SlotBench<AttentionGeneration> generation;
  SlotBench<TargetInHand> in_hand;
  SlotBench<TrackList> tracks;
  JobBench jobs;
  InputBinding inputs[5] = {features.input(), verdicts.input(), tool_poses.input(), generation.input(),
                            in_hand.input()};
  SlotControl* outputs[1] = {&tracks.control()};
  std::span<QueueSink* const> queue_outputs[1] = {jobs.sinks()};
  VisualFeatures of{};
  VisionVerdicts list{};
  std::vector<VisionRegion> posted;
  Pose where = tool;
  bool tells_pose = true;

  World() {
    UnitBinding binding;
    binding.context = &bench.context();
    binding.inputs = inputs;
    binding.outputs = outputs;
    binding.queue_outputs = queue_outputs;
    bench.unit().connect(binding);
    auto& configuration =
        *static_cast<ObjectTracksConfiguration*>(bench.unit().parameter_memory().configuration);
    configuration.camera = camera_of_tests();
    configuration.catalogue = catalogue_of_tests();
    initialised = bench.unit().initialise().is_ok();
  }
  /// The next picture; its verdicts are given in the step after it.
  void picture(Duration after = frame_period) {
    bench.step(after);
    ++of.frame;
    of.time = nanoseconds(bench.now());
    if (tells_pose) tool_poses.publish(where, bench.now());
    features.publish(of, bench.now());
    step();
    posted.clear();
    while (const auto job = jobs.pop()) posted.push_back(*job);
  }
  void step() { bench.step(std::chrono::microseconds(1)); }
  VisionVerdict seen(double x, double y, std::uint16_t kind = 0) {
    VisionVerdict verdict{};
    verdict.region.frame = of.frame;
    verdict.region.time = of.time;
    verdict.region.member = 1;
    verdict.region.identity = 6;
    verdict.verdict = kind == no_kind ? VisualClass::obstacle : VisualClass::target;
    verdict.kind = kind;
    verdict.position = {x, y};
    verdict.angle = 0.3;
    verdict.radius = 0.03;
    verdict.parts = 1;
    return verdict;
  }
  void add(const VisionVerdict& verdict) { list.verdicts[list.count++ % list.verdicts.size()] = verdict; }
  void tell() {
    verdicts.publish(0, list, bench.now());
    step();
  }
  void tell(const VisionVerdict& verdict) {
    add(verdict);
    tell();
  }
  /// Seen in so many pictures.
  void follow(int pictures, double x, double y, std::uint16_t kind = 0, bool probation = false) {
    for (int i = 0; i < pictures; ++i) {
      picture();
      VisionVerdict verdict = seen(x, y, kind);
      verdict.region.probation = probation;
      tell(verdict);
    }
  }
  ObjectTrack first() {
    const auto now = tracks.latest();
    if (now)
      for (const ObjectTrack& track : now->tracks)
        if (track.found != VisualClass::nothing) return track;
    return {};
  }
  std::uint32_t count() {
    const auto now = tracks.latest();
    return now ? now->count : 0;
  }
  bool initialised = false;
};

}  // namespace flexrf::user
