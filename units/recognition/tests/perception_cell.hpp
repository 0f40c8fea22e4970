// A recogniser with its slots, and regions of pictures as attention and tracks give them.
#pragma once

#include <ctime>
#include <memory>
#include <vector>

#include "tests/cmocka.hpp"
#include "units/recognition/recognition.hpp"
#include "units/recognition/tests/seen_tables.hpp"
#include "units/vision/attention_genes.hpp"
#include "units/vision/tests/known_parts.hpp"
#include "units/vision/tests/light_meter.hpp"
#include "units/vision/tests/vision_bench.hpp"

namespace flexrf::user {

/// Of this thread, s.
inline double processor_time() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// A recogniser, and its slots.
struct Cell {
  UnitBench<Recognition> bench;
  FrameBench frames;
  SlotBench<VisualFeatures> features;
  HistoryBench<Pose, 16> tool_poses;
  JobBench tracked;
  JobBench found;
  SlotBench<VisionVerdicts> verdicts;
  InputBinding inputs[4] = {frames.input(), features.input(), tool_poses.input(), {}};
  QueueSource* sources[2] = {tracked.source(), found.source()};
  SlotControl* outputs[1] = {&verdicts.control()};
  LightMeter light;
  const std::unique_ptr<VisualFeatures> told = std::make_unique<VisualFeatures>();  // the light alone
  std::uint64_t frame = 0;
  std::uint64_t read = 0;

  explicit Cell(const CameraModel& camera) {
    UnitBinding binding;
    binding.context = &bench.context();
    binding.inputs = inputs;
    binding.queue_inputs = sources;
    binding.outputs = outputs;
    bench.unit().connect(binding);
    auto& configuration =
        *static_cast<RecognitionConfiguration*>(bench.unit().parameter_memory().configuration);
    configuration.camera = camera;
    configuration.catalogue = catalogue_of_tests();
    assert_true(bench.unit().initialise().is_ok());
  }
  void show(const SeenTable& table) {
    bench.step(std::chrono::milliseconds(33));
    frames.draw(table.picture());
    light.look(table.picture(), {static_cast<int>(table.blind[0]), static_cast<int>(table.blind[1]),
                                 static_cast<int>(table.blind[2]), static_cast<int>(table.blind[3])});
    light.tell(*told);
    features.publish(*told, bench.now());
    tool_poses.publish(table.tool, bench.now());
    frames.publish(++frame, bench.now());
  }
  std::vector<VisionVerdict> ask(VisionRegion job) {
    job.frame = frame;
    (job.member == no_member ? tracked : found).push(job);
    bench.step(std::chrono::milliseconds(1));
    std::vector<VisionVerdict> answers;
    const auto list = verdicts.latest();
    for (; list && read < list->count; ++read) answers.push_back(list->verdicts[read % 32]);
    return answers;
  }
};

inline std::uint16_t kind_of(const SceneBody& part) {
  for (std::size_t i = 0; i < part_kinds; ++i)
    if (part_catalogue[i].kind == part.kind) return static_cast<std::uint16_t>(i);
  return no_kind;
}

inline VisionRegion job_of(const PixelRectangle& rectangle) {
  const PixelRectangle seen = common_part(rectangle, {0, 0, 640, 480});
  VisionRegion job{};
  job.left = static_cast<std::uint16_t>(seen.left);
  job.top = static_cast<std::uint16_t>(seen.top);
  job.width = static_cast<std::uint16_t>(seen.width);
  job.height = static_cast<std::uint16_t>(seen.height);
  job.kind = no_kind;
  return job;
}

/// As attention gives them: larger or smaller than what they show, and beside its middle.
inline VisionRegion region_about(const PixelRectangle& box, SceneRandom& random) {
  constexpr int largest = 200;
  const int side =
      std::clamp(static_cast<int>(std::max(box.width, box.height) * random.between(0.85, 1.35)), 24, largest);
  const int aside = static_cast<int>(side * random.between(-0.25, 0.25));
  const int down = static_cast<int>(side * random.between(-0.25, 0.25));
  return job_of(
      {box.left + (box.width - side) / 2 + aside, box.top + (box.height - side) / 2 + down, side, side});
}

/// As object_tracks gives them, of a part that is known to 1 mm and 3 degrees.
inline VisionRegion tracked_region(const SeenTable& table, const SceneBody& part, SceneRandom& random) {
  const auto kind = kind_of(part);
  const Eigen::Vector3d place(part.position[0] + random.between(-0.001, 0.001),
                              part.position[1] + random.between(-0.001, 0.001), part.size[2]);
  Eigen::Vector2d pixel(-1e4, -1e4);
  table.told.to_picture(place, pixel);
  const double half = (known_parts()[kind].radius + 0.012) * table.told.pixels_per_metre(place);
  VisionRegion job = job_of({static_cast<int>(pixel.x() - half), static_cast<int>(pixel.y() - half),
                             static_cast<int>(2 * half) + 1, static_cast<int>(2 * half) + 1});
  job.member = no_member;
  job.track = 1;
  job.kind = kind;
  job.expected = {place.x(), place.y(), part.angle + random.between(-0.05, 0.05)};
  return job;
}

}  // namespace flexrf::user
