// SceneCamera: a camera on an arm's hand that looks into a scene.
#pragma once

#include <memory>
#include <vector>

#include "hal/camera/interface/virtual_camera.hpp"
#include "hal/scene/interface/scene_arm.hpp"
#include "hal/scene/renderer/hand_eye.hpp"
#include "hal/scene/renderer/scene_renderer.hpp"
#include "scene_camera_driver.hpp"

namespace flexrf {

/// What a picture shows.
struct SceneGlance {
  SceneState state{};
  Eigen::Isometry3d tool = Eigen::Isometry3d::Identity();
};

/// A picture shows scene and arm in the middle of its exposure, and comes one period later: until then the
/// joints are known before and after it. Its control `brightness` is added to every channel. While scene or
/// arm say nothing, it is as one that is not there. It can be given faults.
class SceneCamera : public VirtualCamera<SceneCameraDriver> {
 public:
  SceneCamera();

  Status initialise() override;
  void stop() override;

 protected:
  Duration delay() const noexcept final { return period(); }
  CameraFault injected_fault() const noexcept final { return runtime.injected_fault; }
  const char* blindness() noexcept override;
  bool expose(Time at) noexcept final { return look(at, glance_); }
  void draw(const PictureCanvas& canvas, Time at, std::uint64_t sequence) noexcept final;

  /// What there was to be seen at `at`. False: it is not known. Tests show what they like.
  virtual bool look(Time at, SceneGlance& glance) noexcept;

 private:
  void draw_scene(std::span<std::uint8_t> rgb, std::uint64_t sequence) noexcept;
  void draw_noise(std::span<std::uint8_t> rgb, std::uint64_t sequence) const noexcept;
  const char* missing() noexcept;
  bool joints_at(Time at, std::array<double, max_joints>& joints) noexcept;

  HandEye eye_;
  std::unique_ptr<SceneRenderer> renderer_;
  std::vector<std::uint8_t> rgb_;   // a picture that is given in another format or size
  std::vector<std::uint8_t> line_;  // of a picture that is blurred
  SceneGlance glance_;
  int waited_ = 0;  // cycles
};

}  // namespace flexrf
