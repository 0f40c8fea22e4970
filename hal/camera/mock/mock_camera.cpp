#include "hal/camera/mock/mock_camera.hpp"

namespace flexrf {

MockCamera::MockCamera() {
  offer(0, "brightness", CameraControlKind::integer, 0, 255, 0);
  offer(1, "auto_focus", CameraControlKind::boolean, 0, 1, 1);
  offer(2, "temperature", CameraControlKind::integer, -40, 85, 30, true);
}

Status MockCamera::initialise() {
  next_ = 0;
  noise_.seed(environment().seed);
  return VirtualCamera::initialise();
}

/// Asked for the next when one is taken: what that one shows is then what was planned before.
ComingPicture MockCamera::next_picture() noexcept {
  brightness_ = coming_brightness_;
  if (script_.empty()) return {period(), 0, false};
  if (next_ == script_.size()) return {Duration::max(), 0, false};
  coming_brightness_ = script_[next_].brightness;
  return script_[next_++].coming;
}

void MockCamera::draw(const PictureCanvas& canvas, Time /*at*/, std::uint64_t sequence) noexcept {
  const auto base = script_.empty() ? static_cast<std::uint8_t>(sequence * 4) : brightness_;
  const auto level = static_cast<std::uint8_t>(base + value_of(0));
  std::fill(canvas.data.begin(), canvas.data.end(), level);
  const int most = configuration.noise;
  if (most == 0) return;
  for (std::uint8_t& byte : canvas.data)
    byte = static_cast<std::uint8_t>(std::clamp(byte + noise_.around_zero(most), 0, 255));
}

}  // namespace flexrf
