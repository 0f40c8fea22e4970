// VividWorld: the conformance suite's world on the kernel's virtual camera, whose calls are watched.
#pragma once

#include <linux/videodev2.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <memory>
#include <mutex>
#include <vector>

#include "hal/camera/conformance/camera_bench.hpp"
#include "hal/camera/v4l2/tests/vivid.hpp"
#include "hal/camera/v4l2/v4l2_camera.hpp"

namespace flexrf {

/// The kernel; it notes what was queued for it to fill, and refuses what it is told to.
class WatchedCalls final : public VideoCalls {
 public:
  int control(int descriptor, unsigned long request, void* argument) noexcept override {
    {
      const std::lock_guard lock(mutex_);
      if (request == refused_) {
        if (!refuses_always_) refused_ = 0;
        return -EIO;
      }
      if (request == VIDIOC_S_FMT &&
          static_cast<v4l2_format*>(argument)->type == V4L2_BUF_TYPE_VIDEO_CAPTURE) {
        v4l2_pix_format& asked = static_cast<v4l2_format*>(argument)->fmt.pix;
        asked.bytesperline = padding == 0 ? 0 : asked.width + padding;
      }
      if (request == VIDIOC_QBUF) note(*static_cast<const v4l2_buffer*>(argument));
    }
    const int result = VideoCalls::control(descriptor, request, argument);
    if (padding > 0 && result >= 0) count_the_gaps(request, argument);
    return result;
  }

  /// Once, or until it is told otherwise; 0: nothing.
  void refuse(unsigned long request, bool always = false) {
    const std::lock_guard lock(mutex_);
    refused_ = request;
    refuses_always_ = always;
  }
  std::size_t count() {
    const std::lock_guard lock(mutex_);
    return queued_.size();
  }
  bool has_queued(const std::uint8_t* address) {
    const std::lock_guard lock(mutex_);
    return std::find(queued_.begin(), queued_.end(), address) != queued_.end();
  }

  /// Bytes between a row's pixels, of which each takes one, and the next row; asked of the camera, which may
  /// leave as many as it likes. Before start().
  std::uint32_t padding = 0;

 private:
  /// vivid leaves gaps between rows and fills the rest of the buffer, and says that it filled fewer bytes.
  void count_the_gaps(unsigned long request, void* argument) {
    const std::lock_guard lock(mutex_);
    if (request == VIDIOC_S_FMT) picture_size_ = static_cast<const v4l2_format*>(argument)->fmt.pix.sizeimage;
    if (request == VIDIOC_DQBUF) static_cast<v4l2_buffer*>(argument)->bytesused = picture_size_;
  }
  void note(const v4l2_buffer& buffer) {
    if (buffer.memory == V4L2_MEMORY_USERPTR && buffer.type == V4L2_BUF_TYPE_VIDEO_CAPTURE)
      queued_.push_back(reinterpret_cast<const std::uint8_t*>(buffer.m.userptr));
  }

  std::mutex mutex_;  // the camera's thread and its keeper
  unsigned long refused_ = 0;
  bool refuses_always_ = false;
  std::uint32_t picture_size_ = 0;
  std::vector<const std::uint8_t*> queued_;
};

class VividWorld final : public CameraWorld {
 public:
  VividWorld() { vivid_.restore(); }
  ~VividWorld() override {
    VividWorld::permit();
    stop();
    vivid_.let_go();
    vivid_.plug_in();
    vivid_.restore();
  }

  Status start(const CameraRequest& request) override {
    stop();
    camera_ = std::make_unique<CameraBench<V4l2Camera>>(request);
    camera_->bench().environment().virtual_time = false;
    camera_->bench().configuration().user_pointers = user_pointers;
    set_text(camera_->bench().configuration().device, device);
    camera_->driver().use(calls);
    if (forbidden_ && !deny()) return Status::error(StatusCode::internal, "seteuid");
    return camera_->driver().initialise();
  }
  void stop() override {
    if (camera_ != nullptr) camera_->driver().stop();
  }
  Camera& camera() override { return camera_->driver(); }
  const CameraFeedback& feedback() override { return camera_->bench().feedback(); }
  SlotControl* slot() override { return camera_->slot(); }
  Status set_controls(std::string_view controls) override { return camera_->set_controls(controls); }
  void receive() override {
    pollfd wanted{camera_->driver().descriptor(), POLLIN, 0};
    poll(&wanted, 1, 10);
    camera_->bench().receive(MonotonicClock::now() - camera_->bench().now());
  }
  Time now() const override { return camera_->bench().now(); }

  bool unplug() override { return vivid_.unplug(); }
  bool plug_in() override {
    vivid_.plug_in();
    return true;
  }
  bool fall_silent() override { return drop(100); }
  bool speak_again() override { return drop(0); }
  bool lose() override { return drop(40); }
  bool damage() override { return vivid_.set("Inject V4L2_BUF_FLAG_ERROR", 1); }
  bool occupy() override { return vivid_.occupy(); }
  bool let_go() override {
    vivid_.let_go();
    return true;
  }
  bool forbid() override {
    vivid_.plug_in();
    forbidden_ = true;
    return true;
  }
  /// At once, of all threads.
  bool deny() {
    forbidden_ = true;
    return seteuid(nobody) == 0;
  }
  void permit() override {
    if (forbidden_ && seteuid(0) != 0) std::perror("seteuid");
    forbidden_ = false;
  }
  bool has_sizes_of_its_own() const override { return true; }

  Vivid& vivid() { return vivid_; }

  WatchedCalls calls;
  const char* device = Vivid::path;
  bool user_pointers = true;

 private:
  static constexpr uid_t nobody = 65534;

  bool drop(int percent) { return vivid_.set("Percentage of Dropped Buffers", percent); }

  Vivid vivid_;
  bool forbidden_ = false;
  std::unique_ptr<CameraBench<V4l2Camera>> camera_;
};

}  // namespace flexrf
