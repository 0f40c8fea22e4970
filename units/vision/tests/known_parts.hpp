// The parts of the simulated scene, as a cell's table draws them for the units.
#pragma once

#include <cstdlib>
#include <cstring>
#include <numbers>

#include "hal/scene/interface/part_catalogue.hpp"
#include "units/vision/part_model.hpp"

namespace flexrf::user {

inline SurfaceColour colour_of_tests(const BodyColour& colour) {
  return {colour.red, colour.green, colour.blue};
}

inline PartCatalogue catalogue_of_tests() {
  constexpr double right = std::numbers::pi / 2;
  const std::array<std::array<PartGrasp, 4>, part_kinds> grasps{{
      {{{0, 0, right, 0.030}, {0.012, 0, right, 0.030}, {0, 0, 0, 0.050}, {}}},
      {{{0, 0, 0, 0.040}, {}, {}, {}}},
      {{{0, 0, right, 0.036}, {}, {}, {}}},
      {{{0.0125, -0.0061, right, 0.018},
        {-0.0111, 0.0175, 0, 0.018},
        {-0.0111, 0.0049, right, 0.040},
        {0.0049, -0.0061, 0, 0.050}}},
  }};
  PartCatalogue catalogue{};
  catalogue.table = colour_of_tests(table_colour);
  for (std::size_t kind = 0; kind < part_kinds; ++kind) {
    const flexrf::PartModel& model = part_catalogue[kind];
    PartDrawing& drawing = catalogue.parts[kind];
    drawing.set_name(model.name);
    if (model.symmetry == 0)
      drawing.radius = model.length / 2;
    else
      for (std::size_t i = 0; i < model.outline.count; ++i)
        drawing.outline[i] = {model.outline.corners[i].x, model.outline.corners[i].y};
    drawing.height = model.height;
    drawing.colour = colour_of_tests(model.colour);
    drawing.symmetry = static_cast<std::uint8_t>(model.symmetry);
    drawing.bin.middle = {part_bins[kind].middle.x, part_bins[kind].middle.y};
    drawing.bin.size = {part_bins[kind].size.x, part_bins[kind].size.y};
    for (std::size_t i = 0; i < grasps[kind].size(); ++i) drawing.grasps[i] = grasps[kind][i];
  }
  return catalogue;
}

inline const KnownParts& parts_of_tests() {
  static const KnownParts parts = [] {
    KnownParts known;
    if (!known.take(catalogue_of_tests())) std::abort();
    return known;
  }();
  return parts;
}

inline std::span<const PartModel> known_parts() {
  return parts_of_tests().all();
}
inline SurfaceColour known_table_colour() {
  return colour_of_tests(table_colour);
}

}  // namespace flexrf::user
