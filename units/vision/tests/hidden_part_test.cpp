#include "units/vision/hidden_part.hpp"

#include "motion/pose_conversion.hpp"
#include "tests/cmocka.hpp"
#include "units/vision/tests/drawn_table.hpp"

namespace flexrf::hidden_part_test {
namespace {

using namespace flexrf;
using namespace flexrf::user;

CameraModel camera_with(std::array<std::uint32_t, 4> blind) {
  CameraModel camera = camera_of_tests();
  camera.blind = blind;
  return camera;
}

/// In the tool's frame, so far ahead of the lens, where the pixel shows it.
Eigen::Vector3d shown_at(const CameraModel& camera, double column, double row, double ahead) {
  return to_isometry(camera.mount) *
         Eigen::Vector3d((column - camera.principal_point[0]) / camera.focal_length * ahead,
                         (row - camera.principal_point[1]) / camera.focal_length * ahead, ahead);
}

TargetInHand holding(const Eigen::Vector3d& one, const Eigen::Vector3d& other) {
  TargetInHand hand{};
  hand.held_from_map() = one.cwiseMin(other);
  hand.held_to_map() = one.cwiseMax(other);
  return hand;
}

bool is(const PixelRectangle& found, int left, int top, int width, int height) {
  return found.left == left && found.top == top && found.width == width && found.height == height;
}

bool an_empty_hand_hides_what_the_table_says() {
  const CameraModel camera = camera_with({0, 450, 640, 30});
  const TargetInHand empty{};
  return is(hidden_part(camera, nullptr), 0, 450, 640, 30) &&
         is(hidden_part(camera, &empty), 0, 450, 640, 30);
}

/// A point in it hides its surroundings: a hand-eye transform is a bit off.
bool a_held_part_hides_what_it_covers() {
  const CameraModel camera = camera_with({0, 0, 0, 0});
  const Eigen::Vector3d place = shown_at(camera, 300, 200, 0.1);
  const TargetInHand hand = holding(place, place + Eigen::Vector3d(0, 0, 1e-9));
  const PixelRectangle hidden = hidden_part(camera, &hand);
  return hidden.holds(300, 200) && hidden.holds(291, 191) && hidden.holds(308, 208) && hidden.width < 30 &&
         hidden.height < 30;
}

/// Together with the strip that is always blind.
bool both_are_hidden() {
  const CameraModel camera = camera_with({0, 450, 640, 30});
  const TargetInHand hand = holding(shown_at(camera, 250, 350, 0.1), shown_at(camera, 390, 470, 0.1));
  const PixelRectangle hidden = hidden_part(camera, &hand);
  return hidden.left == 0 && hidden.right() == 640 && hidden.bottom() == 480 && hidden.top <= 350 &&
         hidden.top > 320;
}

/// One that the camera does not see, or that lies behind it, hides nothing more.
bool what_is_not_seen_hides_nothing() {
  const CameraModel camera = camera_with({0, 450, 640, 30});
  const TargetInHand beside = holding(shown_at(camera, 900, 200, 0.1), shown_at(camera, 1000, 300, 0.1));
  const TargetInHand behind = holding(shown_at(camera, 300, 200, -0.2), shown_at(camera, 330, 230, -0.1));
  return is(hidden_part(camera, &beside), 0, 450, 640, 30) &&
         is(hidden_part(camera, &behind), 0, 450, 640, 30);
}

template <bool (*Run)()>
void check(void**) {
  assert_true(Run());
}

}  // namespace
}  // namespace flexrf::hidden_part_test

int main() {
  using namespace flexrf::hidden_part_test;
  const CMUnitTest tests[] = {
      cmocka_unit_test(check<an_empty_hand_hides_what_the_table_says>),
      cmocka_unit_test(check<a_held_part_hides_what_it_covers>),
      cmocka_unit_test(check<both_are_hidden>),
      cmocka_unit_test(check<what_is_not_seen_hides_nothing>),
  };
  return cmocka_run_group_tests_name("hidden part", tests, nullptr, nullptr);
}
