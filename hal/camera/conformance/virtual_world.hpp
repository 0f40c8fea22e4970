// A world in memory: a camera that is only imagined, on a clock that the test moves.
#pragma once

#include "hal/camera/conformance/camera_bench.hpp"
#include "hal/camera/interface/virtual_camera.hpp"

namespace flexrf {

template <class Driver>
class VirtualCameraWorld : public CameraWorld {
 public:
  Status start(const CameraRequest& request) override {
    camera_.reset();
    camera_ = std::make_unique<CameraBench<Driver>>(request);
    if (forbidden_)
      camera_->driver().refuse(Status::error(StatusCode::not_permitted, "scripted: no right to the camera"));
    camera_->driver().cable().plugged = plugged_;
    camera_->driver().cable().occupied = occupied_;
    return camera_->driver().initialise();
  }
  void stop() override {
    if (camera_ != nullptr) camera_->driver().stop();
  }
  Camera& camera() override { return camera_->driver(); }
  const CameraFeedback& feedback() override { return camera_->bench().feedback(); }
  SlotControl* slot() override { return camera_->slot(); }
  Status set_controls(std::string_view controls) override { return camera_->set_controls(controls); }
  void receive() override { camera_->bench().receive(std::chrono::milliseconds(10)); }
  Time now() const override { return camera_->bench().now(); }

  bool unplug() override { return set_plugged(false); }
  bool plug_in() override { return set_plugged(true); }
  bool fall_silent() override {
    camera_->driver().cable().silent = true;
    return true;
  }
  bool speak_again() override {
    camera_->driver().cable().silent = false;
    return true;
  }
  bool occupy() override {
    occupied_ = true;
    return true;
  }
  bool let_go() override {
    camera_->driver().cable().occupied = occupied_ = false;
    return true;
  }
  bool forbid() override {
    forbidden_ = true;
    return true;
  }
  void permit() override { forbidden_ = false; }
  bool lose() override {
    camera_->driver().cable().to_lose = 3;
    return true;
  }
  bool compresses() const override { return true; }
  bool damage() override {
    camera_->driver().cable().to_damage = 1;
    return true;
  }

 private:
  bool set_plugged(bool plugged) {
    plugged_ = plugged;
    if (camera_ != nullptr) camera_->driver().cable().plugged = plugged;
    return true;
  }

  bool plugged_ = true;
  bool occupied_ = false;
  bool forbidden_ = false;
  std::unique_ptr<CameraBench<Driver>> camera_;
};

}  // namespace flexrf
