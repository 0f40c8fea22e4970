// What PickerMachine goes by: distances, times, and which of its states need what. Private to it.
#pragma once

#include <chrono>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "base/time.hpp"
#include "types/picker_state.hpp"

namespace flexrf::user::picker {

// Via points are passed within these distances: there the arm turns off into the next way. In m.
inline constexpr double passes_height = 0.02;
inline constexpr double passes_point = 0.03;
inline constexpr double passes_over = 0.012;
// So near the place above the grasp the part's place is as seen last; there the arm comes to rest.
inline constexpr double last_seen_within = 0.008;
// Where it has to be: as near as joint sensors tell. In m and rad.
inline constexpr double arrives = 0.006;
inline constexpr double arrives_at_grasp = 0.002;
inline constexpr double arrives_turned = 0.03;
// An arm that rests so near to where it should be has arrived as far as it will.
inline constexpr double rests_near = 0.004;
// A goal that moves farther than this from one step to the next lies on another straight way; m.
inline constexpr double same_way = 0.004;
// A goal that moves farther than this sideways is gone to anew, over all that stands there.
inline constexpr double follows = 0.012;
// The arm rests elsewhere for so long: it does not get there.
inline constexpr Duration stuck = std::chrono::milliseconds(1500);
// Who has led the arm by hand may go on.
inline constexpr Duration hand_pause = std::chrono::milliseconds(500);
// So many pictures in a row have to tell something before the arm moves by what it sees again.
inline constexpr std::uint32_t sees_again = 5;
// Number of pictures that have to show all of the place into which the hand goes down next.
inline constexpr std::uint32_t watched_pictures = 2;
// So many pictures are looked at while the arm rests above the straight way down.
inline constexpr std::uint32_t rest_pictures = 4;
// A place that moves farther than this is another one, which is watched anew; m and rad. Around it the hand's
// own room is watched, wider by this.
inline constexpr double same_watch = 0.004;
inline constexpr double same_watch_turned = 0.05;
// If the camera cannot tell what stands in the bin the hand looks from farther away, in steps, up to so much;
// m.
inline constexpr double look_step = 0.02;
inline constexpr double most_look_step = 0.04;
// So long a failure is shown at least.
inline constexpr Duration shown = std::chrono::milliseconds(500);
// So much wider than the part the fingers have to be to have let it go, in m.
inline constexpr double lets_go = 0.012;
// So near the opening that they were told fingers come to rest, in m.
inline constexpr double opens_within = 0.002;
// So near the place where it was let go a part comes to lie, in m.
inline constexpr double falls_within = 0.1;
// Pictures of before are looked at until then.
inline constexpr Duration picture_age = std::chrono::milliseconds(150);
// Time and cost of ways, roughly.
inline constexpr double travel_speed = 0.6;  // m/s
inline constexpr double turn_speed = 2.0;    // rad/s

/// The angle that looks the same as `angle` and is nearest to `before`.
inline double nearest_angle(double angle, double before, int symmetry) {
  if (symmetry == 0) return before;
  return before + std::remainder(angle - before, 2 * std::numbers::pi / symmetry);
}

inline bool needs_sight(PickerState state) {
  switch (state) {
    case PickerState::surveying:
    case PickerState::waiting:
    case PickerState::approaching:
    case PickerState::looking:
    case PickerState::descending:
    case PickerState::lifting:
    case PickerState::carrying:
    case PickerState::looking_into_bin:
    case PickerState::lowering:
    case PickerState::retreating:
    case PickerState::target_lost:
    case PickerState::unreachable:
    case PickerState::blocked:
    case PickerState::grasp_failed:
    case PickerState::part_lost:
      return true;
    default:
      return false;
  }
}

inline bool is_on_way(PickerState state) {
  switch (state) {
    case PickerState::surveying:
    case PickerState::approaching:
    case PickerState::descending:
    case PickerState::lifting:
    case PickerState::carrying:
    case PickerState::lowering:
    case PickerState::retreating:
      return true;
    default:
      return false;
  }
}

/// Others come between.
inline bool interrupts(PickerState state) {
  switch (state) {
    case PickerState::off:
    case PickerState::paused:
    case PickerState::no_sight:
    case PickerState::led_by_others:
    case PickerState::gripper_trouble:
      return true;
    default:
      return false;
  }
}

/// Up, as fast as the arm can: it does not first come to rest on the way that it leaves, which may lead into
/// what is in the way.
inline bool gives_up(PickerState state) {
  return state == PickerState::target_lost || state == PickerState::unreachable ||
         state == PickerState::blocked || state == PickerState::grasp_failed ||
         state == PickerState::part_lost;
}

/// The place into which the hand goes down next is watched.
inline bool watches(PickerState state) {
  return state == PickerState::looking || state == PickerState::descending ||
         state == PickerState::looking_into_bin;
}

/// To a part that is not in the hand yet.
inline bool is_on_way_to_part(PickerState state) {
  return state == PickerState::approaching || state == PickerState::looking ||
         state == PickerState::descending;
}

}  // namespace flexrf::user::picker
