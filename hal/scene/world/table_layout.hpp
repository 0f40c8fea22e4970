// TableLayout: lays parts and obstacles onto a table, as a seed says.
#pragma once

#include <span>

#include "hal/scene/world/part_pushing.hpp"
#include "hal/scene/world/scene_random.hpp"

namespace flexrf {

/// Twelve parts, three of each kind, in the area of part_catalogue.hpp, and four obstacles, 60 to 120 mm
/// high. A third of the parts touches another one, or stands behind an obstacle as seen from the arm and
/// above: partly hidden, never wholly. None overlaps another.
inline constexpr std::size_t laid_obstacles = 4;

/// All is put away before. Nothing but `random` decides, and where the arm is: nothing is laid into `solids`.
void lay_table(SceneState& state, SceneRandom& random, std::span<const Solid> solids) noexcept;

/// A part at a free place, upright and on the table, and so far from obstacles that a hand finds a way to it;
/// `solids` are in the way, too. False: none was found, and the part is as it was.
bool lay_part(SceneState& state, std::size_t part, std::span<const Solid> solids,
              SceneRandom& random) noexcept;

/// A post on the table. Null: it stands there; else what keeps it from there. The words live for ever.
const char* lay_post(SceneState& state, std::size_t obstacle, PlaneVector place, double diameter,
                     double height, std::span<const Solid> solids) noexcept;

}  // namespace flexrf
