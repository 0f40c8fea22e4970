#include "hal/scene/renderer/scene_renderer.hpp"

#include <cmath>

#include "tests/cmocka.hpp"

namespace {

using namespace flexrf;

// Each case runs in here, so that a failing assertion jumps over no destructor.
template <bool (*Run)()>
void judged(void**) {
  assert_true(Run());
}

struct Pixel {
  int red = 0;
  int green = 0;
  int blue = 0;
  int sum() const { return red + green + blue; }
};

class Studio {
 public:
  explicit Studio(double noise = 0, std::uint64_t seed = 1) {
    RendererPlan plan;
    plan.noise = noise;
    plan.seed = seed;
    renderer_.begin(plan);
    state.light = {0, 0, 1};
    state.light_intensity = 1;
    state.opening = 0.05;
    look_down({0.45, 0, 0.5});
    // Far from the table, and never seen.
    tool.translation() = Eigen::Vector3d(0, 0, 5);
  }

  /// The picture's top is where x points, its left where y does.
  void look_down(const Eigen::Vector3d& from) {
    camera.linear() << 0, -1, 0, -1, 0, 0, 0, 0, -1;
    camera.translation() = from;
  }
  /// From the arm's side, with the horizon level.
  void look_at(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
    const Eigen::Vector3d forward = (to - from).normalized();
    const Eigen::Vector3d right = forward.cross(Eigen::Vector3d::UnitZ()).normalized();
    camera.linear().col(0) = right;
    camera.linear().col(1) = forward.cross(right);
    camera.linear().col(2) = forward;
    camera.translation() = from;
  }
  void take(std::uint64_t frame = 0) { renderer_.draw(state, camera, tool, frame, picture); }

  Pixel at(std::size_t column, std::size_t row) const {
    const std::uint8_t* const pixel = &picture[(row * 640 + column) * 3];
    return {pixel[0], pixel[1], pixel[2]};
  }
  /// Where a point of the scene is seen, by the pinhole's own words.
  Pixel at(const Eigen::Vector3d& point) const {
    const Eigen::Vector3d seen = camera.inverse() * point;
    return at(static_cast<std::size_t>(std::lround(319.5 + 600 * seen.x() / seen.z())),
              static_cast<std::size_t>(std::lround(239.5 + 600 * seen.y() / seen.z())));
  }
  template <class Judge>
  int count(const Judge& is_so) const {
    int found = 0;
    for (std::size_t row = 0; row < 480; ++row)
      for (std::size_t column = 0; column < 640; ++column)
        if (is_so(at(column, row))) ++found;
    return found;
  }

  SceneState state{};
  Eigen::Isometry3d camera = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d tool = Eigen::Isometry3d::Identity();
  std::vector<std::uint8_t> picture = std::vector<std::uint8_t>(std::size_t{640} * 480 * 3);

 private:
  SceneRenderer renderer_;
};

SceneBody box_at(double x, double y, double length, double width, double height) {
  SceneBody box{};
  box.kind = SceneKind::box;
  box.position = {x, y, 0};
  box.size = {length, width, height};
  return box;
}

bool is_blue(const Pixel& pixel) {
  return pixel.blue > 60 && pixel.blue > 2 * pixel.red;
}
bool is_dark(const Pixel& pixel) {
  return pixel.red < 100;
}

// 100 x 60 mm, its upper side 450 mm below the lens: 600 / 0.45 pixels a metre, so 66.7 and 40 from the
// middle.
bool corners_are_where_a_pinhole_has_them() {
  Studio studio;
  studio.state.obstacles[0] = box_at(0.45, 0, 0.1, 0.06, 0.05);
  studio.take();
  const int dark = studio.count(is_dark);
  // 133.3 rows of 80 pixels; the blur makes no more of them dark than of the table bright.
  if (std::abs(dark - 10667) > 220) return false;
  for (const std::size_t row : {175U, 304U}) {
    if (!is_dark(studio.at(281, row)) || !is_dark(studio.at(358, row))) return false;
    if (is_dark(studio.at(277, row)) || is_dark(studio.at(362, row))) return false;
  }
  return !is_dark(studio.at(319, 170)) && !is_dark(studio.at(319, 309));
}

bool a_part_is_seen_at_its_place_and_turned() {
  Studio studio;
  studio.state.parts[0] = part_at(SceneKind::block, {0.50, 0.08}, 0.5);
  studio.take();
  const SineCosine turn = sine_cosine(0.5);
  int wrong = 0;
  for (const double along : {-0.023, 0.023}) {
    for (const double across : {-0.013, 0.013}) {
      const PlaneVector inside = PlaneVector{0.50, 0.08} + turned({along, across}, turn);
      const PlaneVector outside = PlaneVector{0.50, 0.08} + turned({along * 1.2, across * 1.3}, turn);
      if (!is_blue(studio.at(Eigen::Vector3d(inside.x, inside.y, 0.025)))) ++wrong;
      if (is_blue(studio.at(Eigen::Vector3d(outside.x, outside.y, 0.025)))) ++wrong;
    }
  }
  return wrong == 0;
}

// The inner corner of an L is table.
bool a_bracket_is_concave() {
  Studio studio;
  const SceneBody bracket = part_at(SceneKind::bracket, {0.45, 0}, 0);
  studio.state.parts[0] = bracket;
  studio.take();
  const Outline outline = outline_of(bracket);
  const PlaneVector corner = outline.corners[3];
  const auto is_yellow = [&](double x, double y) {
    const Pixel pixel = studio.at(Eigen::Vector3d(0.45 + corner.x + x, corner.y + y, 0.020));
    return pixel.red > 2 * pixel.blue;
  };
  return is_yellow(-0.003, -0.003) && is_yellow(-0.003, 0.003) && is_yellow(0.003, -0.003) &&
         !is_yellow(0.006, 0.006);
}

bool what_is_in_front_hides_what_is_behind() {
  Studio studio;
  studio.look_at({0.05, 0, 0.25}, {0.45, 0, 0});
  studio.state.parts[0] = part_at(SceneKind::block, {0.45, 0}, 1.5707963267948966);
  studio.take();
  const int seen = studio.count(is_blue);
  studio.state.obstacles[0] = box_at(0.41, 0, 0.02, 0.03, 0.12);
  studio.take();
  const int partly = studio.count(is_blue);
  studio.state.obstacles[0] = box_at(0.41, 0, 0.02, 0.15, 0.12);
  studio.take();
  const int hidden = studio.count(is_blue);
  // Before it, it hides nothing of the obstacle.
  studio.state.obstacles[0] = box_at(0.49, 0, 0.02, 0.15, 0.12);
  studio.take();
  return seen > 800 && partly > 100 && partly < seen * 3 / 4 && hidden == 0 &&
         studio.count(is_blue) > seen - 40;
}

// The light stands 45 degrees high where x points: a post's shadow is as long as it is high, on the other
// side.
bool shadows_are_darker() {
  Studio studio;
  const double half = std::sqrt(0.5);
  studio.state.light = {half, 0, half};
  studio.state.obstacles[0] = box_at(0.45, 0, 0.02, 0.02, 0.06);
  studio.take();
  const Pixel shadow = studio.at(Eigen::Vector3d(0.40, 0, 0));
  const Pixel beside = studio.at(Eigen::Vector3d(0.40, 0.03, 0));
  const Pixel beyond = studio.at(Eigen::Vector3d(0.37, 0, 0));
  const double ratio = static_cast<double>(shadow.sum()) / beside.sum();
  const double expected = 0.45 / (0.45 + 0.55 * half);
  return std::abs(ratio - expected) < 0.06 && beyond.sum() > shadow.sum() * 3 / 2;
}

bool sides_are_lit_as_they_face_the_light() {
  Studio studio;
  studio.look_at({0.15, 0.3, 0.3}, {0.45, 0, 0.05});
  studio.state.obstacles[0] = box_at(0.45, 0, 0.1, 0.1, 0.1);
  const double half = std::sqrt(0.5);
  studio.state.light = {-half, 0, half};
  studio.take();
  const int towards = studio.at(Eigen::Vector3d(0.40, 0, 0.05)).sum();
  const int aside = studio.at(Eigen::Vector3d(0.45, 0.05, 0.05)).sum();
  return towards > aside * 5 / 4 && aside > 30;
}

bool bins_are_outlined() {
  Studio studio;
  studio.look_down({0.36, 0.38, 0.4});
  studio.take();
  const Pixel line = studio.at(Eigen::Vector3d(0.36 - 0.08 + 0.0025, 0.38, 0));
  const Pixel inside = studio.at(Eigen::Vector3d(0.36, 0.38, 0));
  return line.sum() > inside.sum() + 150;
}

bool the_hand_is_in_the_picture() {
  Studio studio;
  studio.take();
  const int before = studio.count([](const Pixel& pixel) { return pixel.sum() < 230; });
  studio.tool.linear() = turn_about(Eigen::Vector3d::UnitX(), 3.14159265358979323846);
  studio.tool.translation() = Eigen::Vector3d(0.45, 0, 0.25);
  studio.take();
  const int fingers = studio.count([](const Pixel& pixel) { return pixel.sum() < 230; });
  return before == 0 && fingers > 2000;
}

bool more_light_makes_it_brighter() {
  Studio studio;
  studio.take();
  const int usual = studio.at(320, 240).sum();
  studio.state.light_intensity = 0.5;
  studio.take();
  const int dim = studio.at(320, 240).sum();
  studio.state.light_intensity = 2;
  studio.take();
  return std::abs(dim * 2 - usual) < 12 && studio.at(320, 240).sum() > usual * 3 / 2;
}

// Table and bodies alike.
bool tinted_light_colours_all_it_falls_on() {
  Studio studio;
  studio.state.parts[0] = part_at(SceneKind::block, {0.5, 0}, 0);
  studio.take();
  const Pixel table = studio.at(320, 300);
  const Pixel block = studio.at(Eigen::Vector3d(0.5, 0, 0.025));
  studio.state.light_tint = {0.2, 0, -0.3};
  studio.take();
  const auto is_tinted = [](const Pixel& before, const Pixel& after) {
    return std::abs(after.red - 1.2 * before.red) < 2 && after.green == before.green &&
           std::abs(after.blue - 0.7 * before.blue) < 2;
  };
  return block.blue > block.red && is_tinted(table, studio.at(320, 300)) &&
         is_tinted(block, studio.at(Eigen::Vector3d(0.5, 0, 0.025)));
}

bool above_the_table_is_nothing() {
  Studio studio;
  studio.look_at({0, 0, 0.3}, {1, 0, 0.3});
  studio.take();
  const Pixel sky = studio.at(320, 10);
  return sky.red == 58 && sky.blue == 64 && studio.at(320, 470).red > 100;
}

// With perspective, light, bodies and noise: to the last byte.
bool the_same_input_gives_the_same_bytes() {
  const auto fill = [](Studio& studio) {
    studio.look_at({0.1, 0.05, 0.3}, {0.45, 0, 0});
    studio.state.parts[0] = part_at(SceneKind::disc, {0.45, 0}, 0.3);
    studio.state.parts[1] = part_at(SceneKind::hexagon, {0.40, -0.1}, 0.3);
    studio.state.obstacles[0] = box_at(0.5, 0.1, 0.05, 0.05, 0.1);
  };
  Studio one(2, 7);
  Studio other(2, 7);
  Studio another_seed(2, 8);
  for (Studio* studio : {&one, &other, &another_seed}) {
    fill(*studio);
    studio->take(5);
  }
  if (one.picture != other.picture || one.picture == another_seed.picture) return false;
  const auto before = one.picture;
  one.take(6);
  if (one.picture == before) return false;
  one.take(5);
  return one.picture == before;
}

bool a_covered_lens_sees_black_and_noise() {
  Studio studio(2);
  studio.state.lens_covered = true;
  studio.take();
  const int bright = studio.count([](const Pixel& pixel) { return pixel.red > 14; });
  const int grey = studio.count([](const Pixel& pixel) { return pixel.red > 2; });
  return bright == 0 && grey > 10'000;
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(judged<corners_are_where_a_pinhole_has_them>),
      cmocka_unit_test(judged<a_part_is_seen_at_its_place_and_turned>),
      cmocka_unit_test(judged<a_bracket_is_concave>),
      cmocka_unit_test(judged<what_is_in_front_hides_what_is_behind>),
      cmocka_unit_test(judged<shadows_are_darker>),
      cmocka_unit_test(judged<sides_are_lit_as_they_face_the_light>),
      cmocka_unit_test(judged<bins_are_outlined>),
      cmocka_unit_test(judged<the_hand_is_in_the_picture>),
      cmocka_unit_test(judged<more_light_makes_it_brighter>),
      cmocka_unit_test(judged<tinted_light_colours_all_it_falls_on>),
      cmocka_unit_test(judged<above_the_table_is_nothing>),
      cmocka_unit_test(judged<the_same_input_gives_the_same_bytes>),
      cmocka_unit_test(judged<a_covered_lens_sees_black_and_noise>),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
