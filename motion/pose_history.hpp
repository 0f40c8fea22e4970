// Where an arm's tool and joints were at a time, between the entries of a slot's history.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>

#include "runtime/blackboard/ports.hpp"
#include "types/pose.hpp"

namespace flexrf {

// `part` (0 to 1) of the way from `from` to `to`: the position on the straight line, the orientation by
// spherical linear interpolation (Shoemake 1985), the shorter way round.
inline Pose interpolated(const Pose& from, const Pose& to, double part) noexcept {
  // All zero means not rotated (types/pose.hpp).
  const auto orientation = [](const Pose& pose) {
    Eigen::Quaterniond rotation(Eigen::Vector4d(pose.orientation_map()));
    if (rotation.norm() == 0) rotation.setIdentity();
    return rotation.normalized();
  };
  Pose between{};
  between.position_map() = from.position_map() + part * (to.position_map() - from.position_map());
  between.orientation_map() = orientation(from).slerp(part, orientation(to)).coeffs();
  return between;
}

// Of types whose fields are arrays of numbers with their rates, as JointState: each number on a straight
// line.
template <class Joints>
requires requires(Joints joints) {
  joints.position_map();
  joints.velocity_map();
}
Joints interpolated(const Joints& from, const Joints& to, double part) noexcept {
  Joints between = from;
  between.position_map() = from.position_map() + part * (to.position_map() - from.position_map());
  between.velocity_map() = from.velocity_map() + part * (to.velocity_map() - from.velocity_map());
  return between;
}

// What the slot of `input` (history = true in the unit's table, history = K in the slot's row) would have
// held at `time`, as at the middle of a picture's exposure: interpolated between the entries before and
// after. `value` is as it was when there is none, with the reason:
//   nothing_yet     nothing so late was published yet (ask again), or nothing so early
//   no_longer_kept  it was dropped from the history
//   not_registered  the input is not connected, or its slot keeps no history
// In a step of the unit that the input belongs to; bounded, as History::at() and between() are.
template <class T>
NullReason value_at(const Input<T>& input, Time time, T& value) noexcept {
  T before;
  Time before_at{};
  if (const NullReason reason = input.at(time, before, &before_at); reason != NullReason::none) return reason;
  if (before_at == time) {
    value = before;
    return NullReason::none;
  }
  T after;
  ItemHeader header[1];
  if (input.between(time, Time::max(), header, &after) == 0) return NullReason::nothing_yet;
  const double part = seconds(time - before_at) / seconds(header[0].sampled_at - before_at);
  value = interpolated(before, after, std::clamp(part, 0.0, 1.0));
  return NullReason::none;
}

}  // namespace flexrf
