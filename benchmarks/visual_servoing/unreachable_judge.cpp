#include "benchmarks/visual_servoing/unreachable_judge.hpp"

#include <algorithm>
#include <cmath>

#include "hal/scene/interface/part_catalogue.hpp"
#include "units/vision/tests/known_parts.hpp"

namespace flexrf::bench {
namespace {

using user::ObjectTrack;
using user::PickerState;
using user::TrackList;
using user::VisualClass;

bool says_so(PickerState state) {
  return state == PickerState::blocked || state == PickerState::unreachable;
}

std::uint16_t kind_of(const SceneBody& part) {
  const PartModel* const model = part_model(part.kind);
  return static_cast<std::uint16_t>(model - part_catalogue.data());
}

ObjectTrack track_of(const SceneBody& body, VisualClass found, std::size_t number) {
  ObjectTrack track{};
  track.identity = static_cast<std::uint32_t>(number + 1);
  track.found = found;
  track.position = {body.position[0], body.position[1]};
  track.angle = body.angle;
  track.confirmed = true;
  return track;
}

/// What perfect eyes would see; the place in the list is that in the scene, obstacles behind the parts.
TrackList truth_of(const SceneState& scene) {
  TrackList list{};
  for (std::size_t i = 0; i < scene.parts.size(); ++i) {
    if (scene.parts[i].kind == SceneKind::none || scene.held == i + 1) continue;
    list.tracks[i] = track_of(scene.parts[i], VisualClass::target, i);
    list.tracks[i].kind = kind_of(scene.parts[i]);
  }
  for (std::size_t i = 0; i < scene.obstacles.size(); ++i) {
    const SceneBody& obstacle = scene.obstacles[i];
    if (obstacle.kind == SceneKind::none) continue;
    const std::size_t place = scene.parts.size() + i;
    list.tracks[place] = track_of(obstacle, VisualClass::obstacle, place);
    list.tracks[place].radius = obstacle.kind == SceneKind::box
                                    ? std::hypot(obstacle.size[0], obstacle.size[1]) / 2
                                    : obstacle.size[0] / 2;
  }
  return list;
}

}  // namespace

void UnreachableJudge::look() {
  const PickerState state = cell_.picker().state;
  if (state != state_) {
    // What comes over an approach is the approach's end, and counted as that.
    const bool looks = state_ == PickerState::surveying || state_ == PickerState::waiting;
    at_look_out_ = says_so(state) && (looks || (at_look_out_ && says_so(state_)));
    counted_ = {};
    state_ = state;
  }
  if (at_look_out_) judge();
}

bool UnreachableJudge::is_on_table(const ObjectTrack& part) const {
  return std::none_of(part_bins.begin(), part_bins.end(), [&](const BinModel& bin) {
    return std::abs(part.position[0] - bin.middle.x) < bin.size.x / 2 &&
           std::abs(part.position[1] - bin.middle.y) < bin.size.y / 2;
  });
}

void UnreachableJudge::judge() {
  const auto& plan = cell_.configuration_of<user::PartPickerConfiguration>("picker");
  user::HandShape hand;
  hand.reach = plan.hand_reach;
  user::HandRoom room;
  room.beside_part = plan.beside_part;
  room.to_parts = plan.to_parts;
  room.to_obstacles = plan.to_obstacles;
  room.slant = plan.look_offset;
  const auto scene = cell_.newest<SceneState>("scene");
  const TrackList truth = truth_of(scene);
  for (std::size_t i = 0; i < scene.parts.size(); ++i) {
    const ObjectTrack& part = truth.tracks[i];
    if (counted_[i] || part.identity == 0 || scene.parts[i].position[2] > 0 || !is_on_table(part)) continue;
    const double distance = std::hypot(part.position[0] - plan.base[0], part.position[1] - plan.base[1]);
    if (distance < plan.reach[0] || distance > plan.reach[1]) continue;
    const char* blocked_by = nullptr;
    if (!user::free_grasp(user::parts_of_tests(), part, truth, plan.hand_angle, hand, room, blocked_by))
      continue;
    counted_[i] = true;
    wrong_.push_back({cell_.elapsed(), part.kind, cell_.message()});
  }
}

}  // namespace flexrf::bench
