#include <algorithm>
#include <cmath>
#include <numbers>

#include "units/part_picker/picker_machine.hpp"
#include "units/part_picker/picker_rules.hpp"
#include "units/vision/part_model.hpp"

namespace flexrf::user {

bool PickerMachine::begin_way(const Eigen::Vector2d& to) noexcept {
  way_begin_ = tip().head<2>();
  way_place_ = 0;
  has_risen_ = false;
  is_over_ = false;
  return paths_.plan(way_begin_, to);
}

/// The goal of the way under way is no longer where it was.
bool PickerMachine::has_left(const Eigen::Vector3d& goal) const noexcept {
  return (goal.head<2>() - paths_.points().back()).norm() > picker::follows;
}

/// Up, over all that stands there, and down to `goal`, whose place may change a little meanwhile. True: it is
/// there.
bool PickerMachine::go(const Eigen::Vector3d& goal, double angle) noexcept {
  const Eigen::Vector3d here = tip();
  const double low = plan_.travel_height - picker::passes_height;
  if (!has_risen_ && here.z() < low && (here.head<2>() - goal.head<2>()).norm() > picker::passes_over) {
    aim({way_begin_.x(), way_begin_.y(), plan_.travel_height}, hand_angle());
    return false;
  }
  has_risen_ = true;
  const auto points = paths_.points();
  while (way_place_ + 1 < points.size() &&
         (here.head<2>() - points[way_place_]).norm() < picker::passes_point)
    ++way_place_;
  if (way_place_ + 1 < points.size()) {
    aim({points[way_place_].x(), points[way_place_].y(), plan_.travel_height}, angle);
    return false;
  }
  is_over_ = is_over_ || (here.head<2>() - goal.head<2>()).norm() < picker::passes_over;
  const bool descends = is_over_ || goal.z() >= plan_.travel_height;
  aim({goal.x(), goal.y(), descends ? goal.z() : plan_.travel_height}, angle);
  return is_at(goal, picker::arrives) && is_turned(angle);
}

/// The hand never turns past the half turn from where it is by rule, by which the arm's last joint would wind
/// up: where the shorter way leads there it turns back first.
void PickerMachine::aim(const Eigen::Vector3d& tip, double angle) noexcept {
  const double now = turn_between(plan_.hand_angle, hand_angle());
  const double then = turn_between(plan_.hand_angle, angle);
  const bool winds_up = std::abs(then - now) > std::numbers::pi - 0.1;
  target_ = tool_above(tip, winds_up ? plan_.hand_angle : angle, plan_.hand.reach);
}

bool PickerMachine::is_at(const Eigen::Vector3d& place, double within) const noexcept {
  return (tip() - place).norm() < within;
}

bool PickerMachine::is_turned(double angle) const noexcept {
  return std::abs(turn_between(hand_angle(), angle)) < picker::arrives_turned;
}

Eigen::Vector3d PickerMachine::tip() const noexcept {
  return *view_->tool * Eigen::Vector3d(0, 0, plan_.hand.reach);
}

double PickerMachine::hand_angle() const noexcept {
  const Eigen::Vector3d y = view_->tool->linear().col(1);
  return std::atan2(y.y(), y.x());
}

Eigen::Vector3d PickerMachine::at_grasp(double above) const noexcept {
  return {grasp_.middle.x(), grasp_.middle.y(), plan_.grasp_height + above};
}

/// From there the camera sees the part: a bit behind it, along the hand's -x.
Eigen::Vector3d PickerMachine::over_part() const noexcept {
  const Eigen::Vector2d x(-std::sin(grasp_.angle), std::cos(grasp_.angle));
  const Eigen::Vector2d place = grasp_.middle - plan_.room.slant * x;
  return {place.x(), place.y(), plan_.grasp_height + plan_.look_height};
}

Eigen::Vector3d PickerMachine::over_bin(double height) const noexcept {
  return {spot_.x(), spot_.y(), height};
}

/// From there the camera sees the place in the bin past the part that it holds.
Eigen::Vector3d PickerMachine::beside_bin() const noexcept {
  const Eigen::Vector2d x(-std::sin(grasp_.angle), std::cos(grasp_.angle));
  const Eigen::Vector2d place = spot_ - (plan_.bin_look_offset + look_farther_) * x;
  return {place.x(), place.y(), plan_.travel_height};
}

/// The hand's own room at the grasp; the fingers come from so far behind.
void PickerMachine::watch_grasp(double behind) noexcept {
  const HandShape& hand = plan_.hand;
  const double x = hand.palm_width / 2;
  const double y = std::max(hand.palm_length / 2, grasp_.opening / 2 + hand.finger_thickness);
  ask_to_watch(grasp_.middle,
               {Eigen::Vector2d(-std::max(x, hand.finger_width / 2 + behind), -y), Eigen::Vector2d(x, y)});
}

/// The front half of the hand's room: from so near the rest lies behind the picture's lower edge.
void PickerMachine::watch_ahead_of_grasp() noexcept {
  const HandShape& hand = plan_.hand;
  const double y = std::max(hand.palm_length / 2, grasp_.opening / 2 + hand.finger_thickness);
  ask_to_watch(grasp_.middle, {Eigen::Vector2d(0, -y), Eigen::Vector2d(hand.palm_width / 2, y)});
}

/// The room of the hand and of the part in it.
void PickerMachine::watch_spot() noexcept {
  const Eigen::AlignedBox3d part = held_box();
  const Eigen::Vector2d hand(plan_.hand.palm_width / 2, plan_.hand.palm_length / 2);
  Eigen::AlignedBox2d room(Eigen::Vector2d(-hand), hand);
  room.extend(Eigen::Vector2d(part.min().head<2>()));
  room.extend(Eigen::Vector2d(part.max().head<2>()));
  ask_to_watch(spot_, room);
}

/// About the tip at `middle`, turned as the hand is for the grasp. What is watched already is not asked for
/// anew for a hair's breadth.
void PickerMachine::ask_to_watch(const Eigen::Vector2d& middle, const Eigen::AlignedBox2d& room) noexcept {
  const double wider = plan_.room.to_obstacles + picker::same_watch;
  PickerWatch asked{middle, grasp_.angle, room};
  asked.room.min().array() -= wider;
  asked.room.max().array() += wider;
  if (watch_for_ && (watch_for_->middle - middle).norm() < picker::same_watch &&
      std::abs(turn_between(watch_for_->angle, asked.angle)) < picker::same_watch_turned &&
      watch_for_->room.isApprox(asked.room))
    return;
  watch_for_ = asked;
  watched_pictures_ = 0;
}

/// Those that were taken since it is asked for in this state.
void PickerMachine::count_watched_pictures() noexcept {
  if (view_->tracks == nullptr || !watch_for_) return;
  const TrackList& seen = *view_->tracks;
  const bool is_of_it = seen.watched[0] == watch_for_->middle.x() &&
                        seen.watched[1] == watch_for_->middle.y() && seen.watched[2] == watch_for_->angle;
  if (!is_of_it || seen.watched_at == watched_at_) return;
  watched_at_ = seen.watched_at;
  if (Time{Duration{watched_at_}} > entered_) ++watched_pictures_;
}

/// As it lay when the fingers closed; between them it may have turned a bit.
Eigen::AlignedBox3d PickerMachine::held_box() const noexcept {
  const PartModel& model = plan_.parts->all()[held_.kind];
  const Eigen::Vector2d y(std::cos(held_grasp_.angle), std::sin(held_grasp_.angle));
  const Eigen::Vector2d x(-y.y(), y.x());
  const Eigen::Rotation2Dd turn(held_.angle);
  const double low = plan_.hand.reach + plan_.grasp_height;
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector2d& corner : model.outline()) {
    const Eigen::Vector2d place = Eigen::Vector2d(held_.position_map()) + turn * corner - held_grasp_.middle;
    box.extend(Eigen::Vector3d(place.dot(x), place.dot(y), low));
    box.extend(Eigen::Vector3d(place.dot(x), place.dot(y), low - model.height));
  }
  return box;
}

}  // namespace flexrf::user
