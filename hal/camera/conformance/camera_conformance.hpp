// What every driver of Camera must do. A driver's test makes a world, which is the camera, its cable and
// whoever else uses it, and runs the cases in it.
#pragma once

#include <memory>
#include <string_view>

#include "hal/camera/interface/camera.hpp"

namespace flexrf {

struct CameraRequest {
  std::uint32_t width = 640;
  std::uint32_t height = 360;
  PixelFormat format = PixelFormat::yuyv;
  double frame_rate = 30;  // 1/s
  double silence = 5;      // s
  std::string_view controls{};
  bool into_slot = false;    ///< else it belongs to a unit
  std::size_t elements = 0;  ///< bytes that an item of the slot has; 0: as usual
};

class CameraWorld {
 public:
  virtual ~CameraWorld() = default;

  /// Configures and initialises the camera; one that was started is stopped before.
  virtual Status start(const CameraRequest& request) = 0;
  virtual void stop() = 0;
  virtual Camera& camera() = 0;
  virtual const CameraFeedback& feedback() = 0;
  /// The slot of the last start(), with one reader and three loans; null: it belongs to a unit.
  virtual SlotControl* slot() = 0;
  /// A request to set the runtime parameter; the camera's answer.
  virtual Status set_controls(std::string_view controls) = 0;
  /// The thread's cycle, some milliseconds after the last or when something has come.
  virtual void receive() = 0;
  /// Of the cycle: virtual, or one that counts.
  virtual Time now() const = 0;

  /// False: cannot be made to happen here. Also before start().
  virtual bool unplug() { return false; }
  virtual bool plug_in() { return false; }
  virtual bool fall_silent() { return false; }
  virtual bool speak_again() { return false; }
  virtual bool occupy() { return false; }
  virtual bool let_go() { return false; }
  virtual bool forbid() { return false; }
  virtual void permit() {}
  /// One picture or more of those to come is lost, or comes damaged.
  virtual bool lose() { return false; }
  virtual bool damage() { return false; }
  /// It can be asked for mjpeg.
  virtual bool compresses() const { return false; }
  /// It offers certain sizes, and 642x362 is none of them.
  virtual bool has_sizes_of_its_own() const { return false; }
};

using MakeCameraWorld = std::unique_ptr<CameraWorld> (*)();

/// Runs all cases, each in a world of its own; returns the number that failed, for main().
int run_camera_conformance(const char* driver, MakeCameraWorld make);

}  // namespace flexrf
