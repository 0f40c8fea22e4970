#include <algorithm>

#include "units/part_picker/picker_machine.hpp"
#include "units/part_picker/picker_rules.hpp"

namespace flexrf::user {

void PickerMachine::survey() noexcept {
  const bool is_there = go(plan_.look_out, plan_.hand_angle);
  if (is_there) moved_ = entered_ = view_->now;  // it got there, and looks as long as the camera takes
  // As long as more is found there may be still more.
  const std::size_t known = confirmed_things();
  if (!is_there || known > known_) pictures_ = 0;
  known_ = known;
  if (pictures_ < wishes_->survey_pictures) return;
  needs_survey_ = false;
  since_survey_ = 0;
  if (doubt_) {
    const bool was_binned = is_in_its_bin();
    const std::size_t kind = doubt_->kind;
    doubt_.reset();
    if (!was_binned) {
      ++counters_.lost_parts;
      return fail(PickerState::part_lost, "its release was interrupted, and it does not lie in its bin");
    }
    count_binned(kind);
  }
  choose(true);
}

/// The part in doubt lies in its bin, as far as the look at the table shows. Bins may empty themselves: a
/// part that was let go over its bin, and is not seen beside it, was in it.
bool PickerMachine::is_in_its_bin() const noexcept {
  const PickerBin& bin = plan_.bins[doubt_->kind];
  bool lies_in_it = false;
  bool lies_beside = false;
  for (const ObjectTrack& track : view_->tracks->tracks) {
    const Eigen::Vector2d place = track.position_map();
    if (track.found != VisualClass::target || track.kind != doubt_->kind ||
        (place - doubt_->place).norm() > picker::falls_within)
      continue;
    const bool is_inside = bin.contains(place);
    lies_in_it = lies_in_it || is_inside;
    lies_beside = lies_beside || !is_inside;
  }
  return lies_in_it || (!lies_beside && !doubt_->was_moved);
}

std::size_t PickerMachine::confirmed_things() const noexcept {
  const auto& tracks = view_->tracks->tracks;
  return static_cast<std::size_t>(std::count_if(tracks.begin(), tracks.end(), [](const ObjectTrack& track) {
    return track.found != VisualClass::nothing && track.confirmed;
  }));
}

/// At the look-out, until something changes.
void PickerMachine::watch() noexcept {
  aim(plan_.look_out, plan_.hand_angle);
  if (view_->tracks_are_new) choose(true);
}

void PickerMachine::approach() noexcept {
  if (!follow_track()) return fail(PickerState::target_lost, "it is no longer followed");
  if (const char* const blocked = what_blocks_now(); blocked != nullptr)
    return fail(PickerState::blocked, blocked);
  if (has_left(over_part()) && !begin_way(over_part().head<2>()))
    return fail(PickerState::blocked, paths_.why());
  const bool is_there = go(over_part(), grasp_.angle);
  // Not before the hand is up: what was released last lies between its fingers.
  if (has_risen_ && needs_opening_) open_for_grasp();
  if (!is_there) return;
  measured_frames_ = track_.frames;
  enter(PickerState::looking);
  aim(over_part(), grasp_.angle);
}

void PickerMachine::look() noexcept {
  if (!follow_track()) return fail(PickerState::target_lost, "it is not where it was");
  if (const char* const blocked = what_blocks_now(); blocked != nullptr)
    return fail(PickerState::blocked, blocked);
  if (has_left(over_part())) {
    enter(PickerState::approaching);
    return approach();
  }
  aim(over_part(), grasp_.angle);
  watch_grasp(plan_.room.slant);
  if (needs_opening_) return open_for_grasp();
  const bool is_measured = track_.frames >= measured_frames_ + wishes_->look_pictures;
  const bool is_watched = watched_pictures_ >= picker::watched_pictures;
  if (is_measured && is_watched && is_at(over_part(), picker::arrives) && is_turned(grasp_.angle) &&
      !view_->gripper.moving) {
    return enter(PickerState::descending);
  }
  if (view_->now - entered_ <= wishes_->patience) return;
  leave_alone(track_.identity);
  if (is_measured && !is_watched)
    return fail(PickerState::blocked, "the camera cannot tell what lies beside the part");
  fail(PickerState::target_lost,
       is_measured ? "the hand does not come to rest above it" : "it is not measured from near by");
}

void PickerMachine::descend() noexcept {
  if (!follow_track()) return fail(PickerState::target_lost, "it was lost on the way down");
  if (const char* const blocked = what_blocks_now(); blocked != nullptr)
    return fail(PickerState::blocked, blocked);
  if ((grasp_.middle - way_begin_).norm() > plan_.room.slant + picker::follows)
    return fail(PickerState::target_lost, "it was moved away");
  if (needs_opening_) open_for_grasp();
  if (is_frozen_)
    watch_ahead_of_grasp();
  else
    watch_grasp(0);
  // From there the camera no longer sees all of the part.
  const bool was_frozen = is_frozen_;
  is_frozen_ = is_frozen_ || is_at(at_grasp(plan_.straight_height), picker::last_seen_within);
  constexpr std::uint32_t enough = 3;  // pictures; of fewer the last look above the part counts
  if (is_frozen_ && !was_frozen && watched_pictures_ == 0 && pictures_ >= enough)
    return fail(PickerState::blocked, "the camera cannot tell what lies beside the part");
  // There the arm rests, and a few more pictures are looked at: of an obstacle that came just before they are
  // the last ones.
  if (!is_frozen_ || !view_->arm_rests)
    rest_pictures_ = 0;
  else if (view_->tracks_are_new)
    ++rest_pictures_;
  is_straight_ = is_straight_ || rest_pictures_ >= picker::rest_pictures;
  const Eigen::Vector3d goal = at_grasp(is_straight_ ? 0 : plan_.straight_height);
  aim(goal, grasp_.angle);
  if (!is_straight_) return;
  if (!is_at(goal, picker::arrives_at_grasp) && !(view_->arm_rests && is_at(goal, picker::rests_near)))
    return;
  held_ = track_;
  held_grasp_ = grasp_;
  enter(PickerState::closing);
  act_ = PickerAct::close;
}

void PickerMachine::close() noexcept {
  aim(at_grasp(0), grasp_.angle);
  if (view_->now == entered_ || view_->gripper.moving) return;
  if (view_->gripper.object == GripperObject::gripped) {
    in_hand_ = true;
    return enter(PickerState::lifting);
  }
  ++counters_.failed_grasps;
  if (failed_track_ == track_.identity) leave_alone(track_.identity);
  failed_track_ = track_.identity;
  fail(PickerState::grasp_failed, "the fingers closed on nothing");
}

/// False: it is not held any more, and that was told.
bool PickerMachine::keeps_part() noexcept {
  if (view_->gripper.object == GripperObject::gripped || view_->gripper.moving) return true;
  drop_from_hand();
  if (doubt_) {
    enter(PickerState::retreating);
  } else {
    fail(PickerState::part_lost, "it fell out of the fingers");
  }
  return false;
}

/// It is not between the fingers any more.
void PickerMachine::drop_from_hand() noexcept {
  in_hand_ = false;
  if (!is_release_cut_short_) {
    ++counters_.lost_parts;
    return;
  }
  is_release_cut_short_ = false;
  doubt_ = Doubt{.kind = held_.kind,
                 .place = Eigen::Vector2d(spot_ + held_.position_map() - held_grasp_.middle),
                 .was_moved = (tip().head<2>() - spot_).norm() > picker::passes_over};
  needs_survey_ = true;
}

void PickerMachine::lift() noexcept {
  if (!keeps_part()) return;
  const Eigen::Vector3d goal(grasp_.middle.x(), grasp_.middle.y(), plan_.travel_height);
  aim(goal, grasp_.angle);
  if (tip().z() < plan_.travel_height - picker::passes_height) return;
  begin_carrying();
  if (state_ == PickerState::carrying) carry();
}

void PickerMachine::begin_carrying() noexcept {
  // The hand goes there even if something stands in the bin: from there the camera sees when that is gone.
  look_farther_ = 0;
  is_release_cut_short_ = false;
  find_spot();
  if (begin_way(beside_bin().head<2>())) return enter(PickerState::carrying);
  if (state_ != PickerState::blocked) return fail(PickerState::blocked, paths_.why());
  cause_ = paths_.why();
}

void PickerMachine::carry() noexcept {
  if (!keeps_part()) return;
  if (!go(beside_bin(), grasp_.angle)) return;
  enter(PickerState::looking_into_bin);
  look_into_bin();
}

/// In the state looking_into_bin, and while the picker is blocked beside the bin.
void PickerMachine::look_into_bin() noexcept {
  if (!keeps_part()) return;
  aim(beside_bin(), grasp_.angle);
  watch_spot();
  if (!view_->tracks_are_new) return;
  if (!is_free(spot_)) {
    if (!find_spot()) return wait_beside_bin("an obstacle stands in the bin");
    if (!begin_way(beside_bin().head<2>())) return wait_beside_bin(paths_.why());
    return enter(PickerState::carrying);
  }
  if (watched_pictures_ >= picker::watched_pictures) {
    if (!begin_way(spot_)) return wait_beside_bin(paths_.why());
    enter(PickerState::lowering);
    return lower();
  }
  if (view_->now - entered_ > wishes_->patience) look_from_elsewhere();
}

/// From farther away the camera may see past a part that hides some of the place.
void PickerMachine::look_from_elsewhere() noexcept {
  look_farther_ = look_farther_ < picker::most_look_step ? look_farther_ + picker::look_step : 0;
  if (paths_.is_kept_out(beside_bin().head<2>())) look_farther_ = 0;
  wait_beside_bin("the camera cannot tell what stands in the bin");
  entered_ = view_->now;
}

void PickerMachine::wait_beside_bin(const char* why) noexcept {
  if (!waits_at_bin_) fail(PickerState::blocked, why);
  waits_at_bin_ = true;
  cause_ = why;
  aim(beside_bin(), grasp_.angle);
}

void PickerMachine::lower() noexcept {
  if (!keeps_part()) return;
  // On the way down the camera sees only the hand and its shadow: what tracks then say of the place is not
  // used.
  if (view_->tracks_are_new && !is_over_ && !is_free(spot_))
    return fail(PickerState::blocked, "an obstacle stands in the bin");
  if (!go(over_bin(plan_.drop_height), grasp_.angle)) return;
  enter(PickerState::releasing);
  open(release_opening());
}

double PickerMachine::release_opening() const noexcept {
  return std::min(grasp_.width + 2 * plan_.room.beside_part, plan_.hand.widest);
}

/// By the opening; of fingers that do not tell theirs, by that they rest and hold nothing.
bool PickerMachine::have_let_go() const noexcept {
  if (!view_->gripper.opening) return !view_->gripper.moving && !fingers_hold();
  return *view_->gripper.opening >=
         std::min(grasp_.width + picker::lets_go, release_opening() - picker::opens_within);
}

void PickerMachine::release() noexcept {
  aim(over_bin(plan_.drop_height), grasp_.angle);
  if (view_->now == entered_) return;
  if (!have_let_go()) {
    if (view_->gripper.moving) return;
    cause_ = "the fingers rest before they have let go";
    if (view_->now - entered_ < wishes_->patience) return;
    entered_ = view_->now;
    return open(release_opening());
  }
  in_hand_ = false;
  count_binned(held_.kind);
  // Nothing new is begun without sight, or when a person wants it to wait.
  if (view_->tracks == nullptr) return enter(PickerState::no_sight);
  if (!wishes_->pick) return enter(PickerState::retreating);
  choose(false);
}

void PickerMachine::count_binned(std::size_t kind) noexcept {
  ++counters_.binned;
  ++counters_.binned_by_kind[kind];
  ++since_survey_;
  if (wishes_->survey_after > 0 && since_survey_ >= wishes_->survey_after) needs_survey_ = true;
  if (binned_ != Time{}) counters_.cycle_time = seconds(view_->now - binned_);
  binned_ = view_->now;
}

void PickerMachine::rise_and_go_on() noexcept {
  const double height = std::max(plan_.travel_height, tip().z());
  aim({way_begin_.x(), way_begin_.y(), height}, hand_angle());
  if (!in_hand_ && state_ != PickerState::retreating && view_->now - entered_ < picker::shown) return;
  if (tip().z() < plan_.travel_height - picker::passes_height) return;
  if (in_hand_) {
    if (!keeps_part()) return;
    if (state_ == PickerState::blocked && !view_->tracks_are_new) return;
    return begin_carrying();
  }
  binned_ = Time{};
  choose(false);
}

}  // namespace flexrf::user
