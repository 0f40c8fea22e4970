#include "hal/scene/tabletop/tabletop_scene.hpp"

#include <algorithm>

#include "hal/scene/interface/joint_samples.hpp"
#include "runtime/log/log.hpp"

namespace flexrf {

Status TabletopScene::initialise() {
  for (std::size_t i = 0; i < configuration.links.size(); ++i) {
    const SceneCapsule& link = configuration.links[i];
    if (link.radius >= 0 && link.joint <= chain->joint_count) continue;
    return Status::error(
        StatusCode::invalid_argument,
        "configuration.links[%zu] is at joint %u with a radius of %g m: the arm has joints 1 to "
        "%zu, 0 is its base, and a radius is not below 0",
        i, link.joint, link.radius, chain->joint_count);
  }
  HandModel hand;
  hand.reach = configuration.hand_reach;
  world_.begin(hand, environment().seed);
  chain_ = to_scene_arm(*chain);
  told_chain_ = false;
  return {};
}

void TabletopScene::receive(const Tick& tick) noexcept {
  if (!told_chain_) told_chain_ = arm.publish(chain_, tick.now);
  do_as_a_person_asks();
  step(tick);
  scene.publish(world_.state(), tick.now);
  tell();
}

void TabletopScene::do_as_a_person_asks() noexcept {
  world_.set_light(runtime.light_intensity, runtime.light_azimuth, runtime.light_elevation);
  world_.set_light_tint(runtime.light_tint);
  world_.cover_lens(runtime.cover_lens);
  const PlaneVector place{runtime.place[0], runtime.place[1]};
  if (runtime.push_part > 0)
    answer(world_.push_part(runtime.part, place, runtime.push_way, runtime.push_azimuth));
  if (runtime.add_obstacle > 0) answer(world_.add_obstacle(place));
  if (runtime.remove_obstacles > 0) answer(world_.remove_obstacles());
  if (runtime.lay_table > 0) {
    world_.lay_table();
    answer(nullptr);
  }
}

void TabletopScene::answer(const char* refusal) noexcept {
  feedback.set_refusal(refusal == nullptr ? "" : refusal);
  if (refusal != nullptr) log_warning(name(), "nothing was done: {}", refusal);
}

void TabletopScene::step(const Tick& tick) noexcept {
  const auto joints = true_joints.latest();
  const auto told_fingers = fingers.latest();
  feedback.moves = joints && told_fingers;
  if (!feedback.moves) return;
  JointSample sample;
  sample.time = joints.sampled_at();
  sample.position = joints->position;
  sample.velocity = joints->velocity;
  const ArmFrames frames = frames_of(chain_, joints_after(sample, tick.now));
  std::array<Capsule, TabletopWorld::most_links> links;
  std::size_t count = 0;
  for (const SceneCapsule& told : configuration.links) {
    if (told.radius == 0) continue;
    const Eigen::Isometry3d& frame = frames.links[told.joint];
    links[count].from = frame * Eigen::Vector3d(told.from_map());
    links[count].to = frame * Eigen::Vector3d(told.to_map());
    links[count].radius = told.radius;
    // The base and what turns on it stand on the table.
    links[count++].stands = told.joint <= 1;
  }
  world_.step({.tool = frames.tool, .opening = told_fingers->opening, .links = {links.data(), count}});
}

void TabletopScene::tell() noexcept {
  const TabletopCounts& counts = world_.counts();
  feedback.parts_on_table = counts.parts_on_table;
  feedback.binned = counts.binned;
  feedback.held_part = world_.state().held;
  feedback.touches = counts.touches;
  feedback.contacts = counts.contacts;
  feedback.obstacles = counts.obstacles;
}

}  // namespace flexrf
