// SimulatedCamera: looks at a belt on which a red part passes by.
#pragma once

#include "hal/camera/interface/virtual_camera.hpp"
#include "simulated_camera_driver.hpp"

namespace flexrf {

/// Its pictures depend on nothing but their time since the first one and the control `brightness`.
class SimulatedCamera final : public VirtualCamera<SimulatedCameraDriver> {
 public:
  SimulatedCamera();

  Status initialise() override;

 private:
  ComingPicture next_picture() noexcept override;
  void draw(const PictureCanvas& canvas, Time at, std::uint64_t sequence) noexcept override;

  std::uint64_t planned_ = 0;
  Time origin_{};  // of the belt
};

}  // namespace flexrf
