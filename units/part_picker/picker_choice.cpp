#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "units/part_picker/picker_machine.hpp"
#include "units/part_picker/picker_rules.hpp"
#include "units/vision/part_model.hpp"

namespace flexrf::user {

/// The part that takes the least time among those that can be taken with so much room; null: none can.
const ObjectTrack* PickerMachine::find_part(const HandRoom& room, Grasp& best_grasp, const char*& blocked_by,
                                            bool& out_of_reach) const noexcept {
  const ObjectTrack* best = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (const ObjectTrack& track : view_->tracks->tracks) {
    if (needs_survey_ || view_->nobody_looks || !is_candidate(track)) continue;
    if (!is_in_reach(track)) {
      out_of_reach = true;
      continue;
    }
    const auto grasp =
        free_grasp(*plan_.parts, track, *view_->tracks, plan_.hand_angle, plan_.hand, room, blocked_by);
    if (!grasp) continue;
    const double cost = cost_of(*grasp);
    if (cost >= least) continue;
    least = cost;
    best = &track;
    best_grasp = *grasp;
  }
  return best;
}

void PickerMachine::choose(bool has_surveyed) noexcept {
  Grasp best_grasp;
  const char* blocked_by = nullptr;
  bool out_of_reach = false;
  const ObjectTrack* best = find_part(ample_room(), best_grasp, blocked_by, out_of_reach);
  // Rather a way that is just free than none at all.
  if (best == nullptr && has_surveyed) best = find_part(plan_.room, best_grasp, blocked_by, out_of_reach);
  if (best != nullptr) {
    track_ = *best;
    grasp_ = best_grasp;
    if (begin_way(over_part().head<2>())) {
      ++counters_.approaches;
      ++counters_.approaches_by_kind[track_.kind];
      needs_opening_ = true;
      return enter(PickerState::approaching);
    }
    blocked_by = paths_.why();
    leave_alone(track_.identity);
  }
  track_ = {};
  if (!has_surveyed) {
    if (begin_way(plan_.look_out.head<2>())) return enter(PickerState::surveying);
    return fail(PickerState::blocked, paths_.why());
  }
  const PickerState idle = blocked_by != nullptr ? PickerState::blocked
                           : out_of_reach        ? PickerState::unreachable
                                                 : PickerState::waiting;
  const char* const why =
      blocked_by != nullptr ? blocked_by
      : out_of_reach        ? "all parts that are seen lie beyond the arm's reach, or where it may not go"
      : view_->nobody_looks ? "no member of attention runs, so nobody looks for what is new"
                            : "no part is seen that is not left alone";
  if (state_ != idle || !is_watching_) enter(idle, why);
  cause_ = why;
  is_watching_ = true;
}

/// What is seen from afar is a bit elsewhere from near by: a way that is just free may turn out not to be.
HandRoom PickerMachine::ample_room() const noexcept {
  HandRoom room = plan_.room;
  room.to_obstacles += 0.004;
  room.to_parts += 0.003;
  return room;
}

bool PickerMachine::is_candidate(const ObjectTrack& track) const noexcept {
  return track.identity != 0 && track.found == VisualClass::target && track.may_be_target &&
         track.kind < plan_.bins.size() && plan_.bins[track.kind].exists() &&
         !is_left_alone(track.identity) && !is_in_bin(track);
}

bool PickerMachine::is_left_alone(std::uint32_t identity) const noexcept {
  return std::any_of(left_alone_.begin(), left_alone_.end(), [&](const LeftAlone& one) {
    return one.identity == identity && view_->now < one.until;
  });
}

void PickerMachine::leave_alone(std::uint32_t identity) noexcept {
  left_alone_[next_left_alone_] = {identity, view_->now + wishes_->rest};
  next_left_alone_ = (next_left_alone_ + 1) % left_alone_.size();
}

bool PickerMachine::is_in_reach(const ObjectTrack& track) const noexcept {
  const Eigen::Vector2d place = track.position_map();
  const double distance = (place - plan_.base).norm();
  return distance >= plan_.nearest && distance <= plan_.farthest && !kept_out_.is_kept_out(place);
}

/// It was brought there already, or lies where parts are brought.
bool PickerMachine::is_in_bin(const ObjectTrack& track) const noexcept {
  const Eigen::Vector2d place = track.position_map();
  return std::any_of(plan_.bins.begin(), plan_.bins.end(),
                     [&](const PickerBin& bin) { return bin.contains(place); });
}

/// In s, roughly.
double PickerMachine::cost_of(const Grasp& grasp) const noexcept {
  const double narrow = grasp.width + 2 * plan_.room.beside_part - grasp.opening;
  return (grasp.middle - tip().head<2>()).norm() / picker::travel_speed +
         std::abs(turn_between(hand_angle(), grasp.angle)) / picker::turn_speed + 20 * narrow;
}

/// The part's place as it is known by now. False: it is no longer followed.
bool PickerMachine::follow_track() noexcept {
  if (is_frozen_) return true;
  const auto& tracks = view_->tracks->tracks;
  const auto found = std::find_if(tracks.begin(), tracks.end(), [&](const ObjectTrack& track) {
    return track.identity == track_.identity && track.found == VisualClass::target &&
           track.kind == track_.kind;
  });
  if (found == tracks.end()) return false;
  const double before = track_.angle;
  track_ = *found;
  track_.angle = picker::nearest_angle(found->angle, before, plan_.parts->all()[track_.kind].symmetry);
  const double opening = grasp_.opening;
  grasp_ = grasp_of(*plan_.parts, track_, grasp_.number, grasp_.angle);
  grasp_.opening = opening;
  return true;
}

/// The way that was free may be so no longer: then the part is taken in another way, if there is one.
const char* PickerMachine::what_blocks_now() noexcept {
  if (is_straight_ || !view_->tracks_are_new) return nullptr;
  Grasp grasp = grasp_;
  HandRoom room = plan_.room;
  room.wary = state_ == PickerState::descending;
  if (is_frozen_) {
    // From so near parts are seen in pieces, and the fingers have come from behind.
    room.slant = 0;
    return meets_obstacle(grasp, *view_->tracks, plan_.hand, room) ? in_way_of_hand : nullptr;
  }
  const char* blocked = what_blocks(*plan_.parts, grasp, track_, *view_->tracks, plan_.hand, room);
  if (blocked != nullptr && state_ != PickerState::descending) {
    if (const auto other =
            free_grasp(*plan_.parts, track_, *view_->tracks, plan_.hand_angle, plan_.hand, room, blocked)) {
      blocked = nullptr;
      grasp = *other;
    }
  }
  if (blocked != nullptr) return blocked;
  const bool needs_opening = std::abs(grasp.opening - grasp_.opening) > 1e-4;
  const bool is_wider = grasp.number == grasp_.number && grasp.opening > grasp_.opening;
  if (needs_opening && !is_wider) {
    grasp_ = grasp;
    needs_opening_ = true;
  } else if (grasp.number != grasp_.number) {
    grasp_ = grasp;
  }
  return nullptr;
}

/// A place in the bin beside which nothing stands. False: there is none, and `spot_` is the bin's middle.
bool PickerMachine::find_spot() noexcept {
  const PickerBin& bin = plan_.bins[track_.kind];
  const double part = plan_.parts->all()[track_.kind].radius;
  const Eigen::Vector2d room = (bin.size / 2 - Eigen::Vector2d::Constant(part + 0.005)).cwiseMax(0);
  constexpr std::array<double, 3> places{0, 1, -1};
  for (const double x : places) {
    for (const double y : places) {
      spot_ = tip_over(bin.middle + Eigen::Vector2d(x * room.x(), y * room.y()));
      if (is_free(spot_)) return true;
    }
  }
  spot_ = tip_over(bin.middle);
  return false;
}

/// The tip's place when the part is over that place.
Eigen::Vector2d PickerMachine::tip_over(const Eigen::Vector2d& place) const noexcept {
  return place + held_grasp_.middle - Eigen::Vector2d(held_.position_map());
}

/// No obstacle stands within the hand's reach of the place, however the hand is turned.
bool PickerMachine::is_free(const Eigen::Vector2d& spot) const noexcept {
  const double hand = std::hypot(plan_.hand.palm_length, plan_.hand.palm_width) / 2;
  const auto& tracks = view_->tracks->tracks;
  return std::none_of(tracks.begin(), tracks.end(), [&](const ObjectTrack& track) {
    return track.identity != 0 && track.found == VisualClass::obstacle &&
           (Eigen::Vector2d(track.position_map()) - spot).norm() <
               hand + track.radius + plan_.room.to_obstacles;
  });
}

}  // namespace flexrf::user
