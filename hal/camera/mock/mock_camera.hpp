// MockCamera: a camera whose pictures, faults and absences a test scripts.
#pragma once

#include <vector>

#include "hal/camera/interface/virtual_camera.hpp"
#include "hal/driver/mock/mock_noise.hpp"
#include "mock_camera_driver.hpp"

namespace flexrf {

struct MockPicture {
  ComingPicture coming{};
  std::uint8_t brightness = 0;  ///< of every byte
};

/// Unscripted: one in each period, each a little brighter than the one before. Its control `brightness` is
/// added to every byte.
class MockCamera final : public VirtualCamera<MockCameraDriver> {
 public:
  MockCamera();

  /// These come, and then none. Before initialise(); it goes on after an absence, without the one that was
  /// due.
  void script(std::vector<MockPicture> pictures) { script_ = std::move(pictures); }

  Status initialise() override;

 private:
  ComingPicture next_picture() noexcept override;
  void draw(const PictureCanvas& canvas, Time at, std::uint64_t sequence) noexcept override;

  std::vector<MockPicture> script_;
  std::size_t next_ = 0;
  std::uint8_t coming_brightness_ = 0;
  std::uint8_t brightness_ = 0;
  MockNoise noise_;
};

}  // namespace flexrf
