// PartPushing: parts on a table give way to what touches them, and to each other.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "hal/scene/interface/scene_shapes.hpp"
#include "hal/scene/world/solid.hpp"
#include "types/scene_state.hpp"

namespace flexrf {

inline constexpr std::size_t most_parts = 12;
inline constexpr std::size_t most_obstacles = 8;

/// A body as seen from above, in the scene's frame.
struct Footprint {
  OutlinePieces pieces;
  PlaneVector middle;
  double radius = 0;  ///< m about its middle
  double low = 0;     ///< m, its lower face
  double high = 0;    ///< m

  bool exists() const noexcept { return pieces.count > 0; }
};
/// Of a tilted one it is that of the upright one, from its lowest point to its highest.
Footprint footprint_of(const SceneBody& body) noexcept;

/// The deepest overlap, or the smallest gap, of what the two are made of; nothing that is farther apart than
/// `enough`: its gap is more than that. Heights are not looked at.
Separation separation_of(const Footprint& first, const Footprint& second, double enough = 0) noexcept;
Separation separation_of(const Outline& first, const Footprint& second, double enough = 0) noexcept;

/// Quasi-static: nothing has momentum, and what is no longer touched stays. A part that is pushed without
/// friction at a point moves and turns as the force and torque of the push say, by an ellipsoidal limit
/// surface (Lynch, Maekawa, Tanie 1992, Manipulation and active sensing by pushing using tactile feedback)
/// whose ratio of torque to force is the part's radius of gyration. One thread; allocates nothing.
class PartPushing {
 public:
  /// All footprints anew, as in `state`.
  void begin(const SceneState& state) noexcept;
  void refresh_part(const SceneState& state, std::size_t part) noexcept;

  /// Moves parts that overlap something out of it, but for the held one: by those that push to those that
  /// stand behind. What stands before an obstacle stays, and is pressed. `touched`: of each part, whether a
  /// solid moved it. `pushed`: a part that was moved otherwise, and pushes; most_parts: none.
  void resolve(SceneState& state, std::span<const Solid> solids, std::array<bool, most_parts>& touched,
               std::size_t pushed = most_parts) noexcept;

  const Footprint& part(std::size_t index) const noexcept { return parts_[index]; }
  const Footprint& obstacle(std::size_t index) const noexcept { return obstacles_[index]; }

 private:
  static constexpr int most_turns = 12;

  bool push_by_solids(SceneState& state, std::span<const Solid> solids,
                      std::array<bool, most_parts>& touched) noexcept;
  bool push_each_other(SceneState& state, bool back) noexcept;
  bool push_out_of_obstacles(SceneState& state) noexcept;
  void move(SceneState& state, std::size_t part, const Separation& by, double share) noexcept;
  bool is_loose(const SceneState& state, std::size_t part) const noexcept {
    return parts_[part].exists() && state.held != part + 1;
  }

  std::array<Footprint, most_parts> parts_{};
  std::array<Footprint, most_obstacles> obstacles_{};
  std::array<int, most_parts> rank_{};  // how many parts are between one and what pushes
};

}  // namespace flexrf
