#include "units/attention/attention.hpp"

#include <cmath>
#include <memory>
#include <vector>

#include "tests/cmocka.hpp"
#include "units/vision/tests/drawn_table.hpp"
#include "units/vision/tests/vision_bench.hpp"

namespace {

using namespace flexrf;
using namespace flexrf::user;

const Pose tool = tool_above(0.45, 0, 0.45);

struct World {
  UnitBench<Attention> bench;
  SlotBench<VisualFeatures> features;
  SlotBench<TrackList> tracks;
  HistoryBench<Pose, 8> tool_poses;
  SlotBench<AttentionReport> report;
  JobBench jobs;
  InputBinding inputs[3] = {features.input(), tracks.input(std::chrono::seconds(2)), tool_poses.input()};
  SlotControl* outputs[1] = {&report.control()};
  std::span<QueueSink* const> queue_outputs[1] = {jobs.sinks()};
  FeatureExtractor extractor;
  VisualFeatures of{};
  DrawnTable table{tool};
  std::vector<VisionRegion> regions;

  explicit World(const char* name = "attention[3]") {
    UnitBinding binding;
    binding.context = &bench.context();
    binding.inputs = inputs;
    binding.outputs = outputs;
    binding.queue_outputs = queue_outputs;
    bench.unit().connect(binding);
    bench.unit().set_name(name);
    configure(camera_of_tests());
  }
  void configure(const CameraModel& camera) {
    static_cast<AttentionConfiguration*>(bench.unit().parameter_memory().configuration)->camera = camera;
    initialised = bench.unit().initialise().is_ok();
  }
  void look(double noise = 4) {
    extractor.extract(table.picture(noise).pixels, 1920, of);
    ++of.frame;
    of.time = nanoseconds(bench.now());
    tool_poses.publish(tool, bench.now());
    features.publish(of, bench.now());
    bench.step(std::chrono::milliseconds(33));
    regions.clear();
    while (const auto job = jobs.pop()) regions.push_back(*job);
  }
  /// The number of regions in the middle of which the place is, as far as a third of their side.
  int regions_at(const Eigen::Vector2d& place) {
    Eigen::Vector2d pixel(-1, -1);
    table.view().to_picture({place.x(), place.y(), 0.01}, pixel);
    int count = 0;
    for (const VisionRegion& region : regions)
      if (std::abs(pixel.x() - region.left - 0.5 * region.width) < 0.4 * region.width &&
          std::abs(pixel.y() - region.top - 0.5 * region.height) < 0.4 * region.height)
        ++count;
    return count;
  }
  bool initialised = false;
};

const Eigen::Vector2d places[3] = {{0.38, 0.05}, {0.50, 0.05}, {0.42, -0.08}};

std::unique_ptr<World> three_parts() {
  auto world = std::make_unique<World>();
  for (std::size_t i = 0; i < 3; ++i) world->table.put(known_parts()[i], {places[i], 0.4});
  return world;
}

bool parts_are_found_and_ranked() {
  const auto world = three_parts();
  world->bench.runtime().identity = 9;
  world->bench.runtime().probation = true;
  world->look();
  for (const Eigen::Vector2d& place : places)
    if (world->regions_at(place) < 1) return false;
  for (std::size_t i = 0; i < world->regions.size(); ++i) {
    const VisionRegion& region = world->regions[i];
    if (region.score != 1 - static_cast<double>(i) / 8 || region.member != 3 || region.identity != 9 ||
        !region.probation || region.frame != 1 || region.track != 0 || region.left + region.width > 640 ||
        region.top + region.height > 480)
      return false;
  }
  return world->initialised && world->regions.size() >= 3 && world->regions.size() <= 6;
}

bool loud_weights_win_nothing() {
  const auto loud = three_parts();
  const auto quiet = three_parts();
  auto& weights = quiet->bench.runtime();
  for (double* weight : {&weights.colour, &weights.contrast, &weights.motion, &weights.edges}) *weight /= 4;
  loud->look();
  quiet->look();
  bool same = loud->regions.size() == quiet->regions.size() && !loud->regions.empty();
  for (std::size_t i = 0; same && i < loud->regions.size(); ++i)
    same =
        loud->regions[i].left == quiet->regions[i].left && loud->regions[i].score == quiet->regions[i].score;
  return same;
}

bool regions_do_not_overlap_much() {
  const auto world = three_parts();
  world->bench.runtime().selectivity = 0;
  world->bench.runtime().regions = 8;
  world->look();
  for (const VisionRegion& one : world->regions) {
    for (const VisionRegion& other : world->regions) {
      if (&one == &other) continue;
      const PixelRectangle both = common_part({one.left, one.top, one.width, one.height},
                                              {other.left, other.top, other.width, other.height});
      const int smaller = std::min(one.width, other.width);
      if (!both.is_empty() && both.width * both.height > 0.4 * smaller * smaller) return false;
    }
  }
  return world->regions.size() == 8;
}

bool what_is_asked_for_bounds_the_regions() {
  const auto world = three_parts();
  world->bench.runtime().regions = 1;
  world->look();
  const bool one = world->regions.size() == 1;
  world->bench.runtime().regions = 8;
  world->bench.runtime().selectivity = 1;
  world->look();
  return one && world->regions.size() == 1;
}

bool nothing_stands_out_of_one_colour() {
  const auto world = std::make_unique<World>();
  world->look(0);
  const auto told = world->report.latest();
  return world->regions.empty() && told && told->count == 0 && told->pixels > 0;
}

bool cost_is_declared_and_told() {
  const auto world = three_parts();
  world->look();
  const auto told = world->report.latest();
  const auto grids = window_grids(32, 0.35);
  const auto expected = static_cast<std::uint32_t>(values_per_window * window_count(grids));
  return told && told->pixels == expected && told->count == world->regions.size() && told->frame == 1 &&
         told->genes[gene_smallest] == 32 && told->genes[gene_regions] == 8 &&
         world->bench.feedback().cost == expected;
}

bool the_hand_is_not_looked_at() {
  const auto world = three_parts();
  CameraModel camera = camera_of_tests();
  camera.blind = {0, 0, 640, 480};
  world->configure(camera);
  world->look();
  return world->initialised && world->regions.empty();
}

/// Weighted against, what is followed already is passed over; weighted for, it comes first.
bool expectations_count() {
  const auto world = three_parts();
  TrackList list{};
  list.tracks[0].found = VisualClass::target;
  list.tracks[0].position = {places[0].x(), places[0].y()};
  world->tracks.publish(list, world->bench.now());
  world->bench.runtime().expectation = -1;
  world->bench.runtime().regions = 2;
  world->look();
  const bool passed_over = world->regions_at(places[0]) == 0 && world->bench.feedback().expects == 1;
  world->bench.runtime().expectation = 1;
  world->bench.runtime().regions = 1;
  world->look();
  return passed_over && world->regions_at(places[0]) == 1;
}

bool a_picture_is_looked_at_once() {
  const auto world = three_parts();
  world->look();
  world->bench.step(std::chrono::milliseconds(5));
  const bool once = !world->jobs.pop() && world->bench.feedback().pictures == 1;
  world->bench.unit().reset();
  world->bench.step(std::chrono::milliseconds(5));  // begun anew, it looks at the picture that is there
  return once && world->jobs.pop().has_value();
}

bool a_full_queue_is_told() {
  const auto world = three_parts();
  VisionRegion better{};
  better.score = 100;
  for (int i = 0; i < 64; ++i) world->jobs.push(better);
  world->features.publish(world->of, world->bench.now());
  world->extractor.extract(world->table.picture(4).pixels, 1920, world->of);
  world->features.publish(world->of, world->bench.now());
  world->bench.step(std::chrono::milliseconds(33));
  return world->bench.feedback().lost > 0 && world->bench.feedback().lost == world->bench.feedback().found;
}

void finding(void**) {
  assert_true(parts_are_found_and_ranked());
}
void ranks(void**) {
  assert_true(loud_weights_win_nothing());
}
void suppression(void**) {
  assert_true(regions_do_not_overlap_much());
  assert_true(what_is_asked_for_bounds_the_regions());
}
void nothing(void**) {
  assert_true(nothing_stands_out_of_one_colour());
}
void cost(void**) {
  assert_true(cost_is_declared_and_told());
}
void blind(void**) {
  assert_true(the_hand_is_not_looked_at());
}
void expectation(void**) {
  assert_true(expectations_count());
}
void once(void**) {
  assert_true(a_picture_is_looked_at_once());
}
void full_queue(void**) {
  assert_true(a_full_queue_is_told());
}
void wrong_tables(void**) {
  const auto world = std::make_unique<World>("attention[16]");
  assert_false(world->initialised);
  CameraModel camera = camera_of_tests();
  camera.focal_length = 0;
  const auto other = std::make_unique<World>();
  other->configure(camera);
  assert_false(other->initialised);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(finding),     cmocka_unit_test(ranks),
                              cmocka_unit_test(suppression), cmocka_unit_test(nothing),
                              cmocka_unit_test(cost),        cmocka_unit_test(blind),
                              cmocka_unit_test(expectation), cmocka_unit_test(once),
                              cmocka_unit_test(full_queue),  cmocka_unit_test(wrong_tables)};
  return cmocka_run_group_tests_name("attention", tests, nullptr, nullptr);
}
