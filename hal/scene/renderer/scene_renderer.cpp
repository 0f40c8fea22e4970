#include "hal/scene/renderer/scene_renderer.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "hal/scene/renderer/convex_fill.hpp"
#include "hal/scene/world/scene_random.hpp"

namespace flexrf {
namespace {

constexpr double nearest = 0.005;         // m before the lens; what is nearer is not seen
constexpr double farthest_table = 10;     // m
constexpr double from_all_around = 0.45;  // of the light
constexpr double from_the_light = 0.55;
constexpr double texture_contrast = 0.06;
constexpr std::array<std::uint8_t, 4> colour_of_nothing{58, 60, 64, 0};
constexpr std::array<std::uint8_t, 4> colour_of_cover{2, 2, 2, 0};
constexpr double bin_line = 0.005;  // m

std::uint8_t level(double value) noexcept {
  return static_cast<std::uint8_t>(std::clamp(value + 0.5, 0.0, 255.0));
}

/// `light`: its red, green and blue.
std::array<std::uint8_t, 4> lit(BodyColour colour, const Eigen::Vector3d& light) noexcept {
  return {level(colour.red * light[0]), level(colour.green * light[1]), level(colour.blue * light[2]), 0};
}

}  // namespace

void SceneRenderer::begin(const RendererPlan& plan) {
  plan_ = plan;
  const Pinhole& pinhole = plan.pinhole;
  const std::size_t pixels = std::size_t{pinhole.width} * pinhole.height;
  noise_.begin(plan.seed, plan.noise, std::size_t{3} * pinhole.width);
  finish_.begin(pinhole.width, pinhole.height);
  materials_.assign(pixels, nothing);
  nearness_.assign(pixels, 0.0F);
  table_spans_.assign(pinhole.height, {});
  make_texture();
}

// The table is the same in each run: grains of a few millimetres, from noise that is made smooth.
void SceneRenderer::make_texture() {
  constexpr std::size_t mask = texture_size - 1;
  SceneRandom random;
  random.seed(12);
  std::vector<std::uint8_t> grains(texture_size * texture_size);
  for (std::uint8_t& grain : grains) grain = static_cast<std::uint8_t>(random.below(256));
  texture_.resize(grains.size());
  for (std::size_t row = 0; row < texture_size; ++row) {
    for (std::size_t column = 0; column < texture_size; ++column) {
      unsigned sum = 0;
      for (std::size_t down = 0; down < 3; ++down)
        for (std::size_t right = 0; right < 3; ++right)
          sum += grains[((row + down) & mask) * texture_size + ((column + right) & mask)];
      texture_[row * texture_size + column] = static_cast<std::uint8_t>(sum / 9);
    }
  }
}

void SceneRenderer::draw(const SceneState& state, const Eigen::Isometry3d& camera,
                         const Eigen::Isometry3d& tool, std::uint64_t frame,
                         std::span<std::uint8_t> picture) noexcept {
  if (state.lens_covered) return finish(frame, nullptr, picture);
  View view;
  view.to_camera = camera.inverse();
  view.from_camera = camera.linear();
  view.eye = camera.translation();
  view.light = state.light_map();
  for (std::size_t i = 0; i < 3; ++i)
    view.light_colour[static_cast<Eigen::Index>(i)] = state.light_intensity * (1 + state.light_tint[i]);
  colour_count_ = 0;
  std::fill(nearness_.begin(), nearness_.end(), 0.0F);
  const auto hand = hand_boxes(plan_.hand, state.opening);
  const auto visit_all = [&](const auto& visit) {
    for (const SceneBody& part : state.parts) visit_body(part, visit);
    for (const SceneBody& obstacle : state.obstacles) visit_body(obstacle, visit);
    for (const HandBox& box : hand) visit_box(box, tool, visit);
  };
  draw_table(view);
  draw_bins(view);
  visit_all([&](const SceneFace& face) { draw_shadow(view, face); });
  visit_all([&](const SceneFace& face) { draw_face(view, face); });
  make_shades(view);
  finish(frame, &view, picture);
}

/// The table is where a ray goes down, and meets it not too far away: in each row between two columns, as
/// what the ray gains in height is linear along it.
void SceneRenderer::draw_table(const View& view) noexcept {
  const Pinhole& pinhole = plan_.pinhole;
  const double height = view.eye.z();
  const double least_fall = height / farthest_table;
  for (std::uint32_t row = 0; row < pinhole.height; ++row) {
    std::int32_t first = 0;
    std::int32_t end = 0;
    if (height > 0) {
      const double at_zero = -(view.from_camera * pinhole.direction(0, row)).z() - least_fall;
      const double per_column = -view.from_camera(2, 0) / pinhole.focal_length;
      end = static_cast<std::int32_t>(pinhole.width);
      if (per_column == 0) {
        if (at_zero < 0) end = 0;
      } else {
        const std::int32_t crossing = rounded_up(-at_zero / per_column, pinhole.width);
        (per_column > 0 ? first : end) = crossing;
      }
    }
    table_spans_[row] = {first, end};
    std::uint16_t* const materials = &materials_[std::size_t{row} * pinhole.width];
    std::fill_n(materials, pinhole.width, static_cast<std::uint16_t>(nothing));
    if (first < end) std::fill(materials + first, materials + end, static_cast<std::uint16_t>(table));
  }
}

void SceneRenderer::draw_bins(const View& view) noexcept {
  for (const BinModel& model : part_bins) {
    const PlaneVector from = model.middle - model.size * 0.5;
    const PlaneVector to = model.middle + model.size * 0.5;
    const auto line = [&](double left, double near, double right, double far) {
      const std::array<Eigen::Vector3d, 4> corners{
          Eigen::Vector3d(left, near, 0), Eigen::Vector3d(right, near, 0), Eigen::Vector3d(right, far, 0),
          Eigen::Vector3d(left, far, 0)};
      mark(view, corners, bin);
    };
    line(from.x, from.y, to.x, from.y + bin_line);
    line(from.x, to.y - bin_line, to.x, to.y);
    line(from.x, from.y + bin_line, from.x + bin_line, to.y - bin_line);
    line(to.x - bin_line, from.y + bin_line, to.x, to.y - bin_line);
  }
}

/// A body's shadow is that of those of its faces that see the light.
void SceneRenderer::draw_shadow(const View& view, const SceneFace& face) noexcept {
  if (face.normal.dot(view.light) <= 0 || view.light.z() <= 0) return;
  std::array<Eigen::Vector3d, most_corners> shadow_corners;
  for (std::size_t i = 0; i < face.count; ++i) {
    const Eigen::Vector3d& corner = face.corners[i];
    shadow_corners[i] = corner - view.light * (corner.z() / view.light.z());
    shadow_corners[i].z() = 0;
  }
  mark(view, {shadow_corners.data(), face.count}, in_shadow);
}

void SceneRenderer::mark(const View& view, std::span<const Eigen::Vector3d> corners,
                         Material material) noexcept {
  if (view.eye.z() <= 0) return;
  std::array<PlaneVector, most_corners + 2> seen;
  const std::size_t count = seen_corners(view, corners, seen);
  const Pinhole& pinhole = plan_.pinhole;
  fill_convex({seen.data(), count}, pinhole.width, pinhole.height,
              [&](std::int32_t row, std::int32_t first, std::int32_t end) {
                std::uint16_t* const materials = &materials_[static_cast<std::size_t>(row) * pinhole.width];
                const auto span = table_spans_[static_cast<std::size_t>(row)];
                first = std::max(first, span[0]);
                end = std::min(end, span[1]);
                if (material == in_shadow) {
                  for (std::int32_t column = first; column < end; ++column) materials[column] |= in_shadow;
                } else if (first < end) {
                  std::fill(materials + first, materials + end, static_cast<std::uint16_t>(material));
                }
              });
}

/// In the picture, after what is behind the lens or too near is cut off (Sutherland and Hodgman 1974).
std::size_t SceneRenderer::seen_corners(const View& view, std::span<const Eigen::Vector3d> corners,
                                        std::array<PlaneVector, most_corners + 2>& seen) const noexcept {
  std::size_t count = 0;
  Eigen::Vector3d before = view.to_camera * corners.back();
  for (const Eigen::Vector3d& corner : corners) {
    const Eigen::Vector3d here = view.to_camera * corner;
    const double depth_before = before.z() - nearest;
    const double depth = here.z() - nearest;
    if ((depth_before < 0) != (depth < 0)) {
      const Eigen::Vector3d cut = before + (here - before) * (depth_before / (depth_before - depth));
      seen[count++] = plan_.pinhole.project(cut);
    }
    if (depth >= 0) seen[count++] = plan_.pinhole.project(here);
    before = here;
  }
  return count;
}

void SceneRenderer::draw_face(const View& view, const SceneFace& face) noexcept {
  const double facing = face.normal.dot(view.eye - face.corners[0]);
  if (facing <= 0) return;
  std::array<PlaneVector, most_corners + 2> seen;
  const std::size_t count = seen_corners(view, {face.corners.data(), face.count}, seen);
  if (count < 3) return;
  const auto material = static_cast<std::uint16_t>(first_face + colour_count_);
  const double light = from_all_around + from_the_light * std::max(0.0, face.normal.dot(view.light));
  colours_[material] = lit(face.colour, light * view.light_colour);
  // 1/z of a plane is linear in the picture: with its normal n, all points X have n.X = d, and X is z times
  // the direction of its pixel.
  const Eigen::Vector3d normal = view.to_camera.linear() * face.normal;
  const Pinhole& pinhole = plan_.pinhole;
  const double distance = -facing;
  const double per_column = normal.x() / (pinhole.focal_length * distance);
  const double per_row = normal.y() / (pinhole.focal_length * distance);
  const double at_zero =
      normal.z() / distance - per_column * pinhole.centre_column - per_row * pinhole.centre_row;
  bool is_seen = false;
  fill_convex({seen.data(), count}, pinhole.width, pinhole.height,
              [&](std::int32_t row, std::int32_t first, std::int32_t end) {
                const std::size_t begin = static_cast<std::size_t>(row) * pinhole.width;
                const double in_row = at_zero + per_row * row;
                for (std::int32_t column = first; column < end; ++column) {
                  const std::size_t pixel = begin + static_cast<std::size_t>(column);
                  const auto nearness = static_cast<float>(in_row + per_column * column);
                  if (nearness <= nearness_[pixel]) continue;
                  nearness_[pixel] = nearness;
                  materials_[pixel] = material;
                  is_seen = true;
                }
              });
  if (is_seen) ++colour_count_;
}

void SceneRenderer::make_shades(const View& view) noexcept {
  const double up = std::max(0.0, view.light.z());
  const Eigen::Vector3d dark = from_all_around * view.light_colour;
  const Eigen::Vector3d bright = (from_all_around + from_the_light * up) * view.light_colour;
  for (std::size_t value = 0; value < 256; ++value) {
    const double grain = 1 + texture_contrast * (static_cast<double>(value) - 128) / 64;
    shades_[0][value] = lit(table_colour, grain * bright);
    shades_[1][value] = lit(table_colour, grain * dark);
    shades_[2][value] = lit(bin_colour, bright);
    shades_[3][value] = lit(bin_colour, dark);
  }
  colours_[nothing] = colour_of_nothing;
}

PlaneVector SceneRenderer::texel(const View& view, double column, double row) const noexcept {
  constexpr double per_metre = 1000;
  const Eigen::Vector3d ray = view.from_camera * plan_.pinhole.direction(column, row);
  const double way = -view.eye.z() / ray.z();
  return {(view.eye.x() + ray.x() * way) * per_metre, (view.eye.y() + ray.y() * way) * per_metre};
}

/// Perspective is computed at every sixteenth pixel, and straight in between.
void SceneRenderer::write_row(const View& view, std::uint32_t row, std::uint8_t* out) const noexcept {
  constexpr std::int32_t piece = 16;
  constexpr double one = 65536;                           // texels are counted in parts of it
  constexpr double whole_textures = 1000 * texture_size;  // so that all are above 0, and rounded down
  constexpr std::uint32_t mask = texture_size - 1;
  const std::uint16_t* const materials = &materials_[std::size_t{row} * plan_.pinhole.width];
  const auto write = [&](std::int32_t column, const std::array<std::uint8_t, 4>& colour) {
    std::uint8_t* const pixel = out + std::ptrdiff_t{column} * 3;
    pixel[0] = colour[0];
    pixel[1] = colour[1];
    pixel[2] = colour[2];
  };
  const auto [first, end] = table_spans_[row];
  const auto width = static_cast<std::int32_t>(plan_.pinhole.width);
  for (std::int32_t column = 0; column < std::min(first, width); ++column)
    write(column, colours_[materials[column]]);
  for (std::int32_t column = std::max(end, std::min(first, width)); column < width; ++column)
    write(column, colours_[materials[column]]);
  const auto fixed = [](double texels) { return static_cast<std::int64_t>(texels * one); };
  for (std::int32_t begin = first; begin < end; begin += piece) {
    const std::int32_t until = std::min(begin + piece, end);
    const PlaneVector from = texel(view, begin, row);
    const PlaneVector to = texel(view, until - 1, row);
    const double share = 1.0 / std::max(until - 1 - begin, 1);
    std::int64_t x = fixed(from.x + whole_textures);
    std::int64_t y = fixed(from.y + whole_textures);
    const std::int64_t step_x = fixed((to.x - from.x) * share);
    const std::int64_t step_y = fixed((to.y - from.y) * share);
    for (std::int32_t column = begin; column < until; ++column, x += step_x, y += step_y) {
      const std::uint16_t material = materials[column];
      if (material >= first_face) {
        write(column, colours_[material]);
        continue;
      }
      const std::uint32_t right = static_cast<std::uint32_t>(x >> 16) & mask;
      const std::uint32_t down = static_cast<std::uint32_t>(y >> 16) & mask;
      write(column, shades_[material - table][texture_[down * texture_size + right]]);
    }
  }
}

void SceneRenderer::finish(std::uint64_t frame, const View* view, std::span<std::uint8_t> picture) noexcept {
  const Pinhole& pinhole = plan_.pinhole;
  const std::size_t row_bytes = std::size_t{3} * pinhole.width;
  const auto write = [&](std::uint32_t row) {
    std::uint8_t* const sharp = finish_.sharp_row(row);
    if (view != nullptr) {
      write_row(*view, row, sharp);
    } else {
      std::fill_n(sharp, row_bytes, colour_of_cover[0]);
    }
  };
  write(0);
  for (std::uint32_t row = 0; row < pinhole.height; ++row) {
    if (row + 1 < pinhole.height) write(row + 1);
    finish_.finish_row(row, noise_.row(frame, row), &picture[row * row_bytes]);
  }
}

}  // namespace flexrf
