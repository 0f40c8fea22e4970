// TabletopWorld: what happens on a table at which an arm with two fingers works.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "hal/scene/world/grip.hpp"
#include "hal/scene/world/part_pushing.hpp"
#include "hal/scene/world/scene_random.hpp"
#include "hal/scene/world/solid.hpp"

namespace flexrf {

/// Where arm and fingers are now.
struct HandState {
  Eigen::Isometry3d tool = Eigen::Isometry3d::Identity();  ///< of the hand's frame, in the scene's
  double opening = 0;                                      ///< m between the fingertips
  std::span<const Capsule> links{};                        ///< at most TabletopWorld::most_links
};

struct TabletopCounts {
  std::array<std::uint32_t, part_kinds> binned{};  ///< in the catalogue's order
  std::uint64_t touches = 0;   ///< parts that hand or links began to move, without holding them
  std::uint64_t contacts = 0;  ///< hand, links or held part began to touch an obstacle, or the table
  std::uint32_t parts_on_table = 0;
  std::uint32_t obstacles = 0;
};

/// A world of upright prisms on a plane, quasi-static. Hand and links move where they are told to, and what
/// they meet gives way; nothing stops them. A part is gripped when closing fingers meet it on both sides,
/// moves with the hand, and falls to what is below it when they open. It does not tip over, nothing rolls,
/// the table has no edge. The same seed and the same steps give the same world, on every machine. One thread;
/// allocates nothing.
class TabletopWorld {
 public:
  static constexpr std::size_t most_links = 8;

  /// Lays the table; what was counted begins at 0.
  void begin(const HandModel& hand, std::uint64_t seed) noexcept;
  /// For tests: other parts and obstacles than those that were laid, of which the hand holds none. They do
  /// not overlap.
  void put(const SceneState& bodies) noexcept;

  /// Once in a while, always the same for the same result. Between two steps all moves straight; it is looked
  /// at each millimetre, at most 16 times. The first step puts the hand where it is.
  void step(const HandState& hand) noexcept;

  // What a person does. Null: done; else why not.

  /// `part`: its number, from 1; 0: the one that is nearest to `place`. `way` in m, `azimuth` in rad from x.
  const char* push_part(std::uint32_t part, PlaneVector place, double way, double azimuth) noexcept;
  /// A post of 40 mm, 90 mm high, where nothing stands and the arm is not.
  const char* add_obstacle(PlaneVector place) noexcept;
  /// Those that were added.
  const char* remove_obstacles() noexcept;
  /// Anew, at other places. What the hand holds goes, too.
  void lay_table() noexcept;
  /// The camera's lens, and the light: how bright, and from where, in rad about z and above the table.
  void cover_lens(bool on) noexcept { state_.lens_covered = on; }
  void set_light(double intensity, double azimuth, double elevation) noexcept;
  /// By how much of itself each of red, green and blue is more than in white light; -0.5 to 0.5.
  void set_light_tint(const std::array<double, 3>& tint) noexcept { state_.light_tint = tint; }

  const SceneState& state() const noexcept { return state_; }
  const TabletopCounts& counts() const noexcept { return counts_; }

 private:
  static constexpr std::size_t hand_solids = 3;
  static constexpr std::size_t most_solids = hand_solids + most_links;
  /// What a solid, or behind them the held part, touches: a bit for each obstacle, and one for the table.
  using Contacts = std::array<std::uint16_t, most_solids + 1>;

  struct Links {
    std::array<Capsule, most_links> capsules{};
    std::size_t count = 0;
  };

  void move_to(const Eigen::Isometry3d& tool, double opening, const Links& links) noexcept;
  void hold(const Eigen::Isometry3d& tool, double opening) noexcept;
  void grip(const Between& between, const FingerSpace& space, const Eigen::Isometry3d& tool,
            double opening) noexcept;
  void release() noexcept;
  void fall() noexcept;
  double support_below(std::size_t part) const noexcept;
  void empty_bins() noexcept;
  void count_contacts() noexcept;
  void count_bodies() noexcept;
  std::span<const Solid> solids() const noexcept { return {solids_.data(), solid_count_}; }

  HandModel hand_;
  SceneRandom random_;
  SceneState state_{};
  PartPushing bodies_;
  TabletopCounts counts_;
  std::array<Solid, most_solids> solids_{};
  std::size_t solid_count_ = 0;
  // Of the step before; no tool: there was none.
  std::optional<Eigen::Isometry3d> tool_;
  double opening_ = 0;
  Links links_;
  double held_opening_ = 0;  // at which the held part was gripped
  std::array<bool, most_parts> touched_{};
  std::array<bool, most_parts> touched_before_{};
  Contacts contacts_{};
};

}  // namespace flexrf
