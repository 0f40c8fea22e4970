#include "units/recognition/recognition.hpp"

#include <cmath>
#include <memory>

#include "tests/cmocka.hpp"
#include "units/vision/attention_genes.hpp"
#include "units/vision/integral_images.hpp"
#include "units/vision/tests/drawn_table.hpp"
#include "units/vision/tests/vision_bench.hpp"

namespace {

using namespace flexrf;
using namespace flexrf::user;

const Pose tool = tool_above(0.45, 0, 0.45);
const OutlinePose block_pose{{0.42, 0.03}, 0.5};
const OutlinePose disc_pose{{0.50, -0.04}, 0};

struct World {
  UnitBench<Recognition> bench;
  FrameBench frames;
  SlotBench<VisualFeatures> features;
  HistoryBench<Pose, 16> tool_poses;
  RangeBench<VisionVerdicts, 2> answered;
  SlotBench<TrackList> tracks;
  JobBench tracked;
  JobBench found;
  SlotBench<VisionVerdicts> verdicts;
  InputBinding inputs[6] = {frames.input(), features.input(), tool_poses.input(), answered.input(), {},
                            tracks.input()};
  QueueSource* sources[2] = {tracked.source(), found.source()};
  SlotControl* outputs[1] = {&verdicts.control()};
  DrawnTable table{tool};
  std::uint64_t frame = 0;

  World() {
    UnitBinding binding;
    binding.context = &bench.context();
    binding.inputs = inputs;
    binding.queue_inputs = sources;
    binding.outputs = outputs;
    bench.unit().connect(binding);
    auto& configuration =
        *static_cast<RecognitionConfiguration*>(bench.unit().parameter_memory().configuration);
    configuration.camera = camera_of_tests();
    configuration.catalogue = catalogue_of_tests();
    initialised = bench.unit().initialise().is_ok();
    table.put(known_parts()[0], block_pose);
    table.put(known_parts()[1], disc_pose);
    const auto light = std::make_unique<VisualFeatures>();
    light->white_balance = {256, 256, 256};
    light->sees_table = true;
    features.publish(*light, bench.now());
    frames.draw(table.picture(4));
    give();
  }
  /// The next picture, of the same.
  void give() {
    step();
    publish();
  }
  void publish() {
    tool_poses.publish(tool, bench.now());
    frames.publish(++frame, bench.now());
  }
  void step() { bench.step(std::chrono::milliseconds(33)); }
  VisionRegion job_at(const Eigen::Vector2d& place, double size = 0.07) {
    const PixelRectangle at = table.around(place, size);
    VisionRegion job{};
    job.left = static_cast<std::uint16_t>(at.left);
    job.top = static_cast<std::uint16_t>(at.top);
    job.width = static_cast<std::uint16_t>(at.width);
    job.height = static_cast<std::uint16_t>(at.height);
    job.frame = frame;
    job.member = 2;
    job.identity = 5;
    job.probation = true;
    job.kind = no_kind;
    job.score = 0.5;
    return job;
  }
  std::uint64_t count() {
    const auto list = verdicts.latest();
    return list ? list->count : 0;
  }
  VisionVerdict last() {
    const auto list = verdicts.latest();
    return list && list->count > 0 ? list->verdicts[(list->count - 1) % list->verdicts.size()]
                                   : VisionVerdict{};
  }
  bool last_is(std::uint16_t kind, const OutlinePose& pose) {
    const VisionVerdict verdict = last();
    return verdict.verdict == VisualClass::target && verdict.kind == kind &&
           (verdict.position_map() - pose.position).norm() < 0.001;
  }
  bool initialised = false;
};

bool a_job_is_answered() {
  const auto world = std::make_unique<World>();
  world->found.push(world->job_at(block_pose.position));
  world->step();
  const VisionVerdict verdict = world->last();
  return world->initialised && world->count() == 1 && world->last_is(0, block_pose) &&
         std::abs(verdict.angle - block_pose.angle) < 2 * degree && verdict.region.member == 2 &&
         verdict.region.identity == 5 && verdict.region.probation && verdict.parts == 1 &&
         verdict.pixels > 1000 && verdict.support > 0.9 && verdict.residual < 0.001 && verdict.radius > 0.02;
}

/// What shows the block in the picture, from its corners below and above; and of nothing there is no such
/// place.
bool a_verdict_tells_where_the_picture_shows_it() {
  const auto world = std::make_unique<World>();
  world->found.push(world->job_at(block_pose.position));
  world->step();
  const VisionVerdict block = world->last();
  double left = 1e9;
  double top = 1e9;
  double right = 0;
  double bottom = 0;
  const Eigen::Rotation2Dd turn(block_pose.angle);
  for (const Eigen::Vector2d& corner : known_parts()[0].outline()) {
    const Eigen::Vector2d at = block_pose.position + turn * corner;
    for (const double z : {0.0, known_parts()[0].height}) {
      Eigen::Vector2d pixel(0, 0);
      world->table.view().to_picture({at.x(), at.y(), z}, pixel);
      left = std::min(left, pixel.x());
      right = std::max(right, pixel.x());
      top = std::min(top, pixel.y());
      bottom = std::max(bottom, pixel.y());
    }
  }
  world->found.push(world->job_at({0.42, -0.1}));
  world->step();
  const VisionVerdict nothing = world->last();
  return std::abs(block.left - left) < 3 && std::abs(block.top - top) < 3 &&
         std::abs(block.left + block.width - right) < 3 && std::abs(block.top + block.height - bottom) < 3 &&
         nothing.verdict == VisualClass::nothing && nothing.width == 0;
}

bool an_obstacle_is_shown_as_it_is_seen() {
  const auto world = std::make_unique<World>();
  world->table.put(rectangle_of_tests(0.05, 0.05, 0.01, {70, 70, 75}), {{0.45, 0.12}, 0});
  world->frames.draw(world->table.picture(4));
  world->give();
  world->found.push(world->job_at({0.45, 0.12}, 0.08));
  world->step();
  const VisionVerdict verdict = world->last();
  const PixelRectangle there = world->table.around({0.45, 0.12}, 0.05);
  return verdict.verdict == VisualClass::obstacle && std::abs(verdict.left - there.left) < 6 &&
         std::abs(verdict.top - there.top) < 6 && std::abs(verdict.width - there.width) < 8 &&
         std::abs(verdict.height - there.height) < 8;
}

bool without_a_job_nothing_is_said() {
  const auto world = std::make_unique<World>();
  world->step();
  return world->count() == 0 && world->bench.feedback().done == 0;
}

bool what_is_tracked_comes_first_however_it_scores() {
  const auto world = std::make_unique<World>();
  world->bench.runtime().jobs = 1;
  VisionRegion loud = world->job_at(block_pose.position);
  loud.score = 1000;
  world->found.push(loud);
  VisionRegion tracked = world->job_at(disc_pose.position);
  tracked.member = no_member;
  tracked.track = 4;
  tracked.kind = 1;
  tracked.expected = {disc_pose.position.x(), disc_pose.position.y(), 0};
  world->tracked.push(tracked);
  world->step();
  const bool first = world->count() == 1 && world->last_is(1, disc_pose) && world->last().region.track == 4;
  world->step();
  return first && world->count() == 2 && world->last_is(0, block_pose);
}

/// By this recogniser, and by another one; but a track's place is measured in any case.
bool the_same_is_not_measured_twice() {
  const auto world = std::make_unique<World>();
  world->found.push(world->job_at(block_pose.position));
  world->step();
  const std::uint64_t pixels = world->bench.feedback().pixels;
  world->found.push(world->job_at(block_pose.position + Eigen::Vector2d(0.005, 0)));
  world->step();
  const bool own = world->count() == 2 && world->last().repeated && world->last_is(0, block_pose) &&
                   world->last().pixels == 0 && world->bench.feedback().pixels == pixels;
  VisionVerdicts others{};
  others.count = 1;
  others.verdicts[0] = world->last();
  others.verdicts[0].repeated = false;
  others.verdicts[0].kind = 1;
  others.verdicts[0].position = {0.5, -0.04};
  Eigen::Vector2d pixel(0, 0);
  world->table.view().to_picture({0.50, -0.04, 0.02}, pixel);
  others.verdicts[0].pixel = {pixel.x(), pixel.y()};
  world->answered.publish(1, others, world->bench.now());
  world->found.push(world->job_at(disc_pose.position));
  world->step();
  const bool other =
      world->last().repeated && world->last_is(1, disc_pose) && world->last().region.member == 2;
  VisionRegion tracked = world->job_at(disc_pose.position);
  tracked.member = no_member;
  world->tracked.push(tracked);
  world->step();
  return own && other && !world->last().repeated && world->last_is(1, disc_pose) &&
         world->bench.feedback().repeated == 2;
}

/// A glance tells that a region shows a corner of what was measured; another part of the same kind is another
/// one, and so is what lies in the box of a part and is of another colour.
bool a_piece_of_what_is_known_is_not_measured_again() {
  const auto world = std::make_unique<World>();
  world->found.push(world->job_at(block_pose.position));
  world->step();
  const std::uint64_t pixels = world->bench.feedback().pixels;
  const Eigen::Vector2d corner =
      block_pose.position + Eigen::Rotation2Dd(block_pose.angle) * known_parts()[0].corners[0];
  world->found.push(world->job_at(corner, 0.025));
  world->step();
  const std::uint64_t glanced = world->bench.feedback().pixels - pixels;
  return world->count() == 2 && world->last().repeated && world->last_is(0, block_pose) && glanced > 0 &&
         glanced < pixels / 2;
}

bool another_of_the_same_kind_is_measured() {
  const auto world = std::make_unique<World>();
  const OutlinePose other{block_pose.position + Eigen::Vector2d(0.06, 0.02), 0.2};
  world->table.put(known_parts()[0], other);
  world->frames.draw(world->table.picture(4));
  world->give();
  world->found.push(world->job_at(block_pose.position, 0.05));
  world->step();
  world->found.push(world->job_at(other.position, 0.05));
  world->step();
  return !world->last().repeated && world->last_is(0, other);
}

bool what_lies_in_the_box_of_a_part_is_measured() {
  const auto world = std::make_unique<World>();
  constexpr std::size_t bracket = 3;
  const OutlinePose pose{{0.46, 0.08}, 0};
  const auto& model = known_parts()[bracket];
  world->table.put(model, pose);
  // In the corner of the L: that is the middle of its box, and not of the L.
  Eigen::AlignedBox2d box;
  for (const Eigen::Vector2d& at : model.outline()) box.extend(at);
  const Eigen::Vector2d free =
      pose.position + 2 * box.center() - model.middle + Eigen::Vector2d(0.004, 0.004);
  world->table.put(rectangle_of_tests(0.014, 0.014, 0.01, {70, 70, 75}), {free, 0});
  world->frames.draw(world->table.picture(4));
  world->give();
  world->found.push(world->job_at(pose.position + model.middle, 0.09));
  world->step();
  world->found.push(world->job_at(free, 0.016));
  world->step();
  return world->last().verdict != VisualClass::target || !world->last().repeated;
}

/// Where nothing was found nothing is looked for again, as long as all of it was looked at.
bool where_nothing_was_nothing_is_looked_for_again() {
  const auto world = std::make_unique<World>();
  const Eigen::Vector2d empty(0.42, -0.1);
  world->found.push(world->job_at(empty));
  world->step();
  const std::uint64_t pixels = world->bench.feedback().pixels;
  world->found.push(world->job_at(empty + Eigen::Vector2d(0.003, 0), 0.06));
  world->step();
  const bool covered = world->count() == 2 && world->last().repeated &&
                       world->last().verdict == VisualClass::nothing &&
                       world->bench.feedback().pixels == pixels && world->bench.feedback().repeated == 1;
  world->found.push(world->job_at(empty, 0.12));
  world->step();
  return pixels > 0 && covered && !world->last().repeated && world->bench.feedback().pixels > pixels;
}

/// What lies in the middle of a region is no part: that says nothing of what lies apart from it.
bool beside_what_was_no_part_a_part_is_found() {
  const auto world = std::make_unique<World>();
  const Eigen::Vector2d speck = block_pose.position + Eigen::Vector2d(0, 0.048);
  world->table.put(rectangle_of_tests(0.012, 0.012, 0.002, {70, 70, 75}), {speck, 0});
  world->frames.draw(world->table.picture(4));
  world->give();
  world->found.push(world->job_at(speck, 0.15));
  world->step();
  const bool no_part = world->last().verdict == VisualClass::nothing && world->last().pixels > 0;
  world->found.push(world->job_at(block_pose.position, 0.05));
  world->step();
  return no_part && world->count() == 2 && !world->last().repeated && world->last_is(0, block_pose);
}

/// A speck of a part's colour is too little of the part, for the second region as for the first. A foreign
/// one may be an obstacle, and is measured each time.
bool no_part_is_not_measured_again(SurfaceColour colour, bool is_repeated) {
  const auto world = std::make_unique<World>();
  const Eigen::Vector2d speck(0.45, 0.12);
  world->table.put(rectangle_of_tests(0.012, 0.012, 0.002, colour), {speck, 0});
  world->frames.draw(world->table.picture(4));
  world->give();
  world->found.push(world->job_at(speck, 0.06));
  world->step();
  const VisionVerdict first = world->last();
  world->found.push(world->job_at(speck + Eigen::Vector2d(0.006, 0.004), 0.05));
  world->step();
  return first.verdict == VisualClass::nothing && !first.repeated && first.width > 0 && world->count() == 2 &&
         world->last().repeated == is_repeated && world->last().verdict == VisualClass::nothing;
}

/// A track's region that shows the table alone says nothing of what attention sees there.
bool the_empty_region_of_a_track_hides_no_obstacle() {
  const auto world = std::make_unique<World>();
  const Eigen::Vector2d place(0.45, 0.12);
  VisionRegion tracked = world->job_at(place, 0.05);
  tracked.member = no_member;
  tracked.track = 4;
  tracked.kind = no_kind;
  world->tracked.push(tracked);
  world->step();
  return world->last().verdict == VisualClass::nothing && world->last().width == 0;
}

/// A glance at most of the picture does not see small things: it says nothing of the regions within.
bool what_a_coarse_glance_misses_is_found() {
  const auto world = std::make_unique<World>();
  DrawnTable table{tool};
  const Eigen::Vector2d small(0.45, 0.0);
  table.put(rectangle_of_tests(0.0155, 0.0155, 0.004, {70, 70, 75}), {small, 0});
  world->frames.draw(table.picture(4));
  world->give();
  VisionRegion all = world->job_at(small);
  all.left = all.top = 0;
  all.width = 640;
  all.height = 480;
  world->found.push(all);
  world->step();
  const bool missed = world->last().verdict == VisualClass::nothing;
  world->found.push(world->job_at(small, 0.05));
  world->step();
  return missed && world->count() == 2 && world->last().verdict == VisualClass::obstacle;
}

/// A list with one track, confirmed and measured now.
TrackList one_followed(const World& world, VisualClass found, std::uint16_t kind, const Eigen::Vector2d& at) {
  TrackList list{};
  list.frame = world.frame;
  list.count = 1;
  ObjectTrack& track = list.tracks[3];
  track.identity = 9;
  track.found = found;
  track.kind = kind;
  track.position = {at.x(), at.y()};
  track.body_height = found == VisualClass::target ? known_parts()[kind].height : 0.09;
  track.radius = 0.02;
  track.frames = 20;
  track.confirmed = true;
  track.measured_at = nanoseconds(world.bench.now());
  return list;
}

/// It is the disc that lies there; that the track calls it a hexagon tells that the picture was not looked
/// at.
bool what_is_followed_is_not_measured_for_attention() {
  const auto world = std::make_unique<World>();
  const TrackList list = one_followed(*world, VisualClass::target, 2, disc_pose.position);
  world->give();
  world->tracks.publish(list, world->bench.now());
  VisionRegion job = world->job_at(disc_pose.position);
  job.time = nanoseconds(world->bench.now());
  world->found.push(job);
  world->step();
  const VisionVerdict verdict = world->last();
  const bool told = verdict.repeated && world->last_is(2, disc_pose) && verdict.region.member == 2 &&
                    verdict.pixels == 0 && verdict.width > 10 && world->bench.feedback().pixels == 0;
  // A track's own job is to measure it.
  VisionRegion tracked = job;
  tracked.member = no_member;
  tracked.track = 9;
  tracked.kind = 2;
  world->tracked.push(tracked);
  world->step();
  return told && !world->last().repeated && world->last_is(1, disc_pose);
}

bool an_obstacle_that_is_followed_is_not_measured_for_attention() {
  const auto world = std::make_unique<World>();
  const TrackList list = one_followed(*world, VisualClass::obstacle, no_kind, disc_pose.position);
  world->tracks.publish(list, world->bench.now());
  Eigen::Vector2d pixel(0, 0);
  world->table.view().to_picture({disc_pose.position.x(), disc_pose.position.y(), 0.045}, pixel);
  VisionRegion job = world->job_at(disc_pose.position, 0.08);
  job.left = static_cast<std::uint16_t>(pixel.x() - job.width / 2.0);
  job.top = static_cast<std::uint16_t>(pixel.y() - job.height / 2.0);
  job.time = nanoseconds(world->bench.now());
  world->found.push(job);
  world->step();
  const VisionVerdict verdict = world->last();
  return verdict.repeated && verdict.verdict == VisualClass::obstacle && verdict.radius == 0.02 &&
         verdict.left < pixel.x() && verdict.left + verdict.width > pixel.x() && verdict.width > 20;
}

/// One that is not sure, was missed, was measured long ago or lies elsewhere: the picture is looked at.
bool what_a_track_does_not_know_is_measured() {
  const auto asks = [](const auto& change) {
    const auto world = std::make_unique<World>();
    TrackList list = one_followed(*world, VisualClass::target, 2, disc_pose.position);
    change(list.tracks[3]);
    world->tracks.publish(list, world->bench.now());
    VisionRegion job = world->job_at(disc_pose.position);
    job.time = nanoseconds(world->bench.now());
    world->found.push(job);
    world->step();
    return world->count() == 1 && !world->last().repeated && world->last_is(1, disc_pose);
  };
  return asks([](ObjectTrack& track) { track.confirmed = false; }) &&
         asks([](ObjectTrack& track) { track.misses = 1; }) &&
         asks([](ObjectTrack& track) { track.measured_at -= 300'000'000; }) &&
         asks([](ObjectTrack& track) { track.position[0] -= 0.03; }) &&
         asks([](ObjectTrack& track) { track.found = VisualClass::nothing; });
}

/// Of the next picture it is something else.
bool the_next_picture_is_measured_anew() {
  const auto world = std::make_unique<World>();
  world->found.push(world->job_at(block_pose.position));
  world->step();
  world->give();
  world->found.push(world->job_at(block_pose.position));
  world->step();
  return world->count() == 2 && !world->last().repeated;
}

bool jobs_of_pictures_that_are_gone_are_put_away() {
  const auto world = std::make_unique<World>();
  VisionRegion late = world->job_at(block_pose.position);
  world->found.push(late);
  world->step();  // keeps the picture
  world->give();
  world->found.push(late);
  world->step();
  const bool kept = world->count() == 2;
  world->give();
  world->found.push(world->job_at(disc_pose.position));
  world->step();  // keeps this one
  world->found.push(late);
  late.frame = 0;
  world->found.push(late);
  world->step();
  return kept && world->count() == 3 && world->bench.feedback().outdated == 2;
}

/// It waits for its picture for one step, and no longer: a picture that never comes holds up nobody.
bool a_job_may_be_ahead_of_its_picture() {
  const auto world = std::make_unique<World>();
  VisionRegion early = world->job_at(block_pose.position);
  early.frame = world->frame + 1;
  world->found.push(early);
  world->step();
  const bool waits = world->count() == 0 && world->bench.feedback().outdated == 0;
  world->publish();
  world->step();
  const bool done = world->count() == 1 && world->last_is(0, block_pose);
  early.frame = world->frame + 100;
  world->found.push(early);
  world->found.push(world->job_at(disc_pose.position));
  world->step();
  world->step();
  return waits && done && world->count() == 2 && world->last_is(1, disc_pose) &&
         world->bench.feedback().outdated == 1;
}

/// Its thread has to be released again, though nothing may come into the queue any more; and a job that is
/// held when it begins anew is not lost without a trace.
bool a_job_that_is_held_keeps_it_from_rest_and_is_counted() {
  const auto world = std::make_unique<World>();
  VisionRegion early = world->job_at(block_pose.position);
  early.frame = world->frame + 1;
  world->found.push(early);
  const bool rests = world->bench.unit().is_idle();
  world->step();
  const bool holds = !world->bench.unit().is_idle();
  world->bench.unit().reset();
  const bool dropped = world->bench.unit().is_idle() && world->bench.feedback().outdated == 1;
  world->publish();
  world->step();
  return rests && holds && dropped && world->count() == 0 && world->bench.unit().is_idle();
}

bool without_the_tools_pose_it_says_so() {
  const auto world = std::make_unique<World>();
  world->frames.publish(++world->frame, world->bench.now() + std::chrono::seconds(5));
  world->found.push(world->job_at(block_pose.position));
  world->step();
  const bool told = world->count() == 0 && !world->bench.feedback().trouble_view().empty();
  world->give();
  world->found.push(world->job_at(block_pose.position));
  world->step();
  return told && world->count() == 1 && world->bench.feedback().trouble_view().empty();
}

bool what_is_flat_is_not_even_looked_at() {
  const auto world = std::make_unique<World>();
  FeatureExtractor extractor;
  const auto of = std::make_unique<VisualFeatures>();
  extractor.extract(world->frames.frame().data().data(), 1920, *of);
  of->frame = world->frame;
  of->white_balance = {256, 256, 256};
  world->features.publish(*of, world->bench.now());
  world->found.push(world->job_at({0.36, -0.10}));
  world->step();
  const bool flat = world->count() == 1 && world->last().verdict == VisualClass::nothing &&
                    world->last().pixels == 0 && world->bench.feedback().pixels == 0;
  world->found.push(world->job_at(block_pose.position));
  world->step();
  return flat && world->last_is(0, block_pose);
}

bool any_job_ends_well() {
  const auto world = std::make_unique<World>();
  world->bench.runtime().jobs = 16;
  for (const PixelRectangle at : {PixelRectangle{65535, 65535, 65535, 65535}, PixelRectangle{0, 0, 0, 0},
                                  PixelRectangle{0, 0, 65535, 65535}, PixelRectangle{630, 470, 5, 900}}) {
    VisionRegion job = world->job_at(block_pose.position);
    job.left = static_cast<std::uint16_t>(at.left);
    job.top = static_cast<std::uint16_t>(at.top);
    job.width = static_cast<std::uint16_t>(at.width);
    job.height = static_cast<std::uint16_t>(at.height);
    job.track = 1;
    job.kind = 77;
    job.expected = {1e300, -1e300, std::nan("")};
    world->found.push(job);
  }
  world->step();
  return world->bench.feedback().done == 4;
}

void answers(void**) {
  assert_true(a_job_is_answered());
  assert_true(a_verdict_tells_where_the_picture_shows_it());
  assert_true(an_obstacle_is_shown_as_it_is_seen());
  assert_true(without_a_job_nothing_is_said());
}
void tracked_first(void**) {
  assert_true(what_is_tracked_comes_first_however_it_scores());
}
void repeated(void**) {
  assert_true(the_same_is_not_measured_twice());
  assert_true(a_piece_of_what_is_known_is_not_measured_again());
  assert_true(another_of_the_same_kind_is_measured());
  assert_true(what_lies_in_the_box_of_a_part_is_measured());
  assert_true(where_nothing_was_nothing_is_looked_for_again());
  assert_true(beside_what_was_no_part_a_part_is_found());
  assert_true(no_part_is_not_measured_again(known_parts()[0].colour, true));
  assert_true(no_part_is_not_measured_again({70, 70, 75}, false));
  assert_true(the_empty_region_of_a_track_hides_no_obstacle());
  assert_true(what_a_coarse_glance_misses_is_found());
  assert_true(the_next_picture_is_measured_anew());
}
void followed(void**) {
  assert_true(what_is_followed_is_not_measured_for_attention());
  assert_true(an_obstacle_that_is_followed_is_not_measured_for_attention());
  assert_true(what_a_track_does_not_know_is_measured());
}
void outdated(void**) {
  assert_true(jobs_of_pictures_that_are_gone_are_put_away());
}
void early(void**) {
  assert_true(a_job_may_be_ahead_of_its_picture());
  assert_true(a_job_that_is_held_keeps_it_from_rest_and_is_counted());
}
void no_pose(void**) {
  assert_true(without_the_tools_pose_it_says_so());
}
void flat(void**) {
  assert_true(what_is_flat_is_not_even_looked_at());
}
void any_job(void**) {
  assert_true(any_job_ends_well());
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(answers),  cmocka_unit_test(tracked_first), cmocka_unit_test(repeated),
      cmocka_unit_test(followed), cmocka_unit_test(outdated),      cmocka_unit_test(early),
      cmocka_unit_test(no_pose),  cmocka_unit_test(flat),          cmocka_unit_test(any_job)};
  return cmocka_run_group_tests_name("recognition", tests, nullptr, nullptr);
}
