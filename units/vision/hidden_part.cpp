#include "units/vision/hidden_part.hpp"

#include <cmath>

#include "units/vision/camera_view.hpp"

namespace flexrf::user {
namespace {

// A hand-eye transform is a bit off, and a held part has turned between the fingers.
constexpr double around = 12;  // px

}  // namespace

PixelRectangle hidden_part(const CameraModel& camera, const TargetInHand* hand) noexcept {
  const PixelRectangle blind{static_cast<int>(camera.blind[0]), static_cast<int>(camera.blind[1]),
                             static_cast<int>(camera.blind[2]), static_cast<int>(camera.blind[3])};
  if (hand == nullptr || hand->held_from == hand->held_to) return blind;
  const CameraView view(camera, Pose{});  // in the tool's frame
  constexpr double far = 1e6;             // px
  Eigen::Vector2d low(far, far);
  Eigen::Vector2d high(-far, -far);
  for (int corner = 0; corner < 8; ++corner) {
    Eigen::Vector3d place;
    for (int i = 0; i < 3; ++i)
      place[i] = ((corner >> i) & 1) == 0 ? hand->held_from[static_cast<std::size_t>(i)]
                                          : hand->held_to[static_cast<std::size_t>(i)];
    Eigen::Vector2d pixel;
    if (!view.to_picture(place, pixel)) continue;
    low = low.cwiseMin(pixel.cwiseMax(-far));
    high = high.cwiseMax(pixel.cwiseMin(far));
  }
  if (low.x() > high.x()) return blind;
  const PixelRectangle held{static_cast<int>(low.x() - around), static_cast<int>(low.y() - around),
                            static_cast<int>(high.x() - low.x() + 2 * around),
                            static_cast<int>(high.y() - low.y() + 2 * around)};
  const PixelRectangle seen =
      common_part(held, {0, 0, static_cast<int>(camera.width), static_cast<int>(camera.height)});
  return around_both(blind, seen);
}

}  // namespace flexrf::user
