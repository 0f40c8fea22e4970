// Where two fingers can take a part that lies among others, and whether they get there without touching
// anything else.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <span>

#include "types/object_track.hpp"
#include "types/track_list.hpp"
#include "units/vision/part_model.hpp"

namespace flexrf::user {

/// The hand, about the point between its fingertips; x is across the closing direction, y along it, as the
/// tool's frame. In m.
struct HandShape {
  double reach = 0.16;              ///< from the tool's frame to the fingertips
  double finger_width = 0.02;       ///< along x
  double finger_thickness = 0.008;  ///< along y
  double palm_width = 0.05;         ///< along x
  double palm_length = 0.13;        ///< along y
  double widest = 0.085;            ///< between the fingers, fully open
};

/// How much room is wanted about it. In m.
struct HandRoom {
  double beside_part = 0.010;   ///< between part and open finger, where there is room
  double least_beside = 0.004;  ///< where there is little
  double to_parts = 0.002;      ///< between a finger and other parts
  double to_obstacles = 0.004;  ///< between fingers or palm and obstacles
  double slant = 0.03;          ///< the fingers come from so far behind, along -x
  bool wary = false;            ///< of what is not confirmed yet, too
};

/// One way to take a part.
struct Grasp {
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();  ///< between the fingertips, in the robot's frame, m
  double angle = 0;                                  ///< of the closing direction (the tool's y) about z, rad
  double width = 0;                                  ///< of what is between the closed fingers, m
  double opening = 0;                                ///< to come with, m
  std::uint8_t number = 0;                           ///< among those of the part's kind
};

/// The turn from one direction to another, within half a turn, in rad.
double turn_between(double from, double to) noexcept;

/// Ways to take a part of a kind; none for a kind that is not known.
std::span<const PartGrasp> grasps_of(const KnownParts& parts, std::uint16_t kind) noexcept;

/// The n-th way to take the part where the track says that it is. Of the two hands that are half a turn apart
/// the one whose closing direction is nearer to `preferred` (rad).
Grasp grasp_of(const KnownParts& parts, const ObjectTrack& track, std::size_t number,
               double preferred) noexcept;

/// What keeps the hand from it; nullptr: nothing, and `grasp.opening` is as wide as there is room for. The
/// words live for ever.
const char* what_blocks(const KnownParts& parts, Grasp& grasp, const ObjectTrack& track, const TrackList& all,
                        const HandShape& hand, const HandRoom& room) noexcept;

/// Some obstacle stands in the way of the hand at this grasp.
bool meets_obstacle(const Grasp& grasp, const TrackList& all, const HandShape& hand,
                    const HandRoom& room) noexcept;
inline constexpr const char* in_way_of_hand = "an obstacle is in the way of the hand";

/// The free way to take it that turns the hand least, away from `preferred`, and by less than half a turn;
/// nothing, and `blocked_by` told,
/// where none is free.
std::optional<Grasp> free_grasp(const KnownParts& parts, const ObjectTrack& track, const TrackList& all,
                                double preferred, const HandShape& hand, const HandRoom& room,
                                const char*& blocked_by) noexcept;

/// The pose of the tool that has the point between its fingertips there, pointing straight down.
Eigen::Isometry3d tool_above(const Eigen::Vector3d& tip, double angle, double reach) noexcept;

}  // namespace flexrf::user
