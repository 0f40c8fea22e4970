// CameraBench: a camera and, if it has one, its slot, for tests.
#pragma once

#include <memory>

#include "base/text.hpp"
#include "hal/camera/conformance/camera_conformance.hpp"
#include "hal/camera/interface/picture_size.hpp"
#include "hal/driver/device_bench.hpp"
#include "runtime/blackboard/sized_slot.hpp"

namespace flexrf {

template <class Driver>
class CameraBench {
 public:
  using PictureSlot = SizedSlot<CameraFrame, 1, 3>;

  explicit CameraBench(const CameraRequest& request)
      : slot_(request.into_slot ? std::make_unique<PictureSlot>(request.elements == 0 ? usual_picture_bytes
                                                                                      : request.elements)
                                : nullptr),
        bench_(nullptr, {}, nullptr, slot()) {
    auto& set = bench_.configuration();
    set.width = request.width;
    set.height = request.height;
    set.format = request.format;
    set.frame_rate = request.frame_rate;
    set.silence = request.silence;
    set_text(bench_.runtime().controls, request.controls);
  }

  DeviceBench<Driver>& bench() { return bench_; }
  Driver& driver() { return bench_.driver(); }
  SlotControl* slot() { return slot_ == nullptr ? nullptr : &slot_->control(); }
  /// As the executive does with a request.
  Status set_controls(std::string_view controls) {
    auto proposed = bench_.runtime();
    set_text(proposed.controls, controls);
    Status status = bench_.driver().accept_runtime(&proposed);
    if (status) bench_.runtime() = proposed;
    return status;
  }

 private:
  std::unique_ptr<PictureSlot> slot_;  // outlives the driver, whose loans are in it
  DeviceBench<Driver> bench_;
};

}  // namespace flexrf
