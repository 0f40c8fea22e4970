// WorldBench: a world with bodies where a test puts them, and a hand that points downwards.
#pragma once

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "hal/scene/world/tabletop_world.hpp"

namespace flexrf {

inline constexpr double half_turn = 3.14159265358979323846;

/// Fingertips at a height, closing along x turned by `turn` and a quarter.
inline Eigen::Isometry3d hand_at(double x, double y, double tips, double turn = 0) {
  Eigen::Isometry3d tool = Eigen::Isometry3d::Identity();
  tool.linear() =
      turn_about(Eigen::Vector3d::UnitZ(), turn) * turn_about(Eigen::Vector3d::UnitX(), half_turn);
  tool.translation() = Eigen::Vector3d(x, y, tips + HandModel{}.reach);
  return tool;
}

class WorldBench {
 public:
  WorldBench() { world.begin(HandModel{}, 1); }

  /// Nothing else is on the table then.
  void put_parts(std::initializer_list<SceneBody> parts, std::initializer_list<SceneBody> obstacles = {}) {
    SceneState state{};
    std::copy(parts.begin(), parts.end(), state.parts.begin());
    std::copy(obstacles.begin(), obstacles.end(), state.obstacles.begin());
    world.put(state);
  }
  /// From where the hand is, in steps of a control cycle's way.
  void move(double x, double y, double tips, double opening, double turn = 0, int steps = 40) {
    for (int i = 1; i <= steps; ++i) {
      const double part = static_cast<double>(i) / steps;
      HandState hand;
      opening_now = opening_ + (opening - opening_) * part;
      hand.tool = hand_at(x_ + (x - x_) * part, y_ + (y - y_) * part, tips_ + (tips - tips_) * part,
                          turn_ + (turn - turn_) * part);
      // As a gripper does that is told where it is stopped.
      if (world.state().grip_width > 0) opening_now = std::max(opening_now, world.state().grip_width);
      hand.opening = opening_now;
      world.step(hand);
    }
    x_ = x;
    y_ = y;
    tips_ = tips;
    turn_ = turn;
    opening_ = opening_now;
  }
  /// There at once, above everything on its way.
  void jump(double x, double y, double tips, double opening, double turn = 0) {
    move(x_, y_, 0.3, opening_, turn_);
    move(x, y, 0.3, opening, turn);
    move(x, y, tips, opening, turn);
  }
  const SceneBody& part(std::size_t index) const { return world.state().parts[index]; }
  bool is_at(std::size_t index, double x, double y, double within = 1e-9) const {
    return std::abs(part(index).position[0] - x) <= within && std::abs(part(index).position[1] - y) <= within;
  }

  TabletopWorld world;
  double opening_now = 0.08;

 private:
  double x_ = 0.2;
  double y_ = 0;
  double tips_ = 0.3;
  double turn_ = 0;
  double opening_ = 0.08;
};

/// No two parts overlap, and none an obstacle.
inline bool is_apart(const SceneState& state, double tolerance = 2e-6) {
  for (std::size_t i = 0; i < most_parts; ++i) {
    const Footprint one = footprint_of(state.parts[i]);
    const auto meets = [&](const SceneBody& body) {
      const Footprint other = footprint_of(body);
      return one.exists() && other.exists() && one.low < other.high - 1e-4 && other.low < one.high - 1e-4 &&
             separation_of(one, other).gap < -tolerance;
    };
    for (std::size_t j = i + 1; j < most_parts; ++j)
      if (meets(state.parts[j])) return false;
    for (const SceneBody& obstacle : state.obstacles)
      if (meets(obstacle)) return false;
  }
  return true;
}

}  // namespace flexrf
