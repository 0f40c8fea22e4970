#include "hal/camera/simulated/simulated_camera.hpp"

#include <cmath>

#include "hal/camera/simulated/camera_scene.hpp"

namespace flexrf {
namespace {

bool is_turn(std::uint64_t number, std::uint32_t every) noexcept {
  return every > 0 && number % every == 0;
}

}  // namespace

SimulatedCamera::SimulatedCamera() {
  offer(0, "brightness", CameraControlKind::integer, -100, 100, 0);
  offer(1, "auto_focus", CameraControlKind::boolean, 0, 1, 1);
  offer(2, "temperature", CameraControlKind::integer, -40, 85, 30, true);
}

Status SimulatedCamera::initialise() {
  planned_ = 0;
  origin_ = Time{};
  return VirtualCamera::initialise();
}

ComingPicture SimulatedCamera::next_picture() noexcept {
  ++planned_;
  const bool lost = is_turn(planned_, configuration.lose_every);
  // The one after a lost one comes a period later.
  return {lost ? 2 * period() : period(), lost ? 1U : 0U, is_turn(planned_, configuration.damage_every)};
}

void SimulatedCamera::draw(const PictureCanvas& canvas, Time at, std::uint64_t /*sequence*/) noexcept {
  if (origin_ == Time{}) origin_ = at;
  const double progress = std::fmod(seconds(at - origin_) / configuration.part_period, 1.0);
  CameraScene::draw(canvas, progress, value_of(0));
}

}  // namespace flexrf
