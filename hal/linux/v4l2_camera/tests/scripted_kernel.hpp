// ScriptedKernel: in place of the kernel, a camera that gives what a test injects. One camera, one stream.
#pragma once

#include <linux/videodev2.h>
#include <sys/eventfd.h>
#include <sys/mman.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <mutex>
#include <span>
#include <vector>

#include "hal/linux/v4l2_camera/video_calls.hpp"

namespace flexrf {

class ScriptedKernel final : public VideoCalls {
 public:
  explicit ScriptedKernel(std::uint32_t buffer_size) noexcept : buffer_size_(buffer_size) {}

  /// The next picture, as it lies in the buffer that the driver takes.
  void inject(std::span<const std::uint8_t> bytes, std::uint32_t flags = 0) {
    const std::lock_guard lock(mutex_);
    waiting_.push_back({{bytes.begin(), bytes.end()}, flags, sequence_++});
  }
  /// Whether it was given this buffer to fill.
  bool was_given(const std::uint8_t* data) {
    const std::lock_guard lock(mutex_);
    return std::find(given_.begin(), given_.end(), data) != given_.end();
  }

  int open(const char* /*path*/) noexcept override { return eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK); }

  int control(int /*descriptor*/, unsigned long request, void* argument) noexcept override {
    const std::lock_guard lock(mutex_);
    switch (request) {
      case VIDIOC_QUERYCAP:
        static_cast<v4l2_capability*>(argument)->capabilities = V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_STREAMING;
        return 0;
      case VIDIOC_S_FMT:
        return agree(static_cast<v4l2_format*>(argument)->fmt.pix);
      case VIDIOC_S_PARM:
      case VIDIOC_STREAMON:
      case VIDIOC_STREAMOFF:
        return 0;
      case VIDIOC_REQBUFS:
        buffers_.resize(std::max<std::size_t>(buffers_.size(), 4));
        static_cast<v4l2_requestbuffers*>(argument)->count = 4;
        return 0;
      case VIDIOC_QUERYBUF:
        static_cast<v4l2_buffer*>(argument)->length = buffer_size_;
        static_cast<v4l2_buffer*>(argument)->m.offset = static_cast<v4l2_buffer*>(argument)->index;
        return 0;
      case VIDIOC_QBUF:
        return take(*static_cast<const v4l2_buffer*>(argument));
      case VIDIOC_DQBUF:
        return fill(*static_cast<v4l2_buffer*>(argument));
      default:
        return -EINVAL;  // there are no controls, and nothing to enumerate
    }
  }

  /// The driver unmaps it.
  void* map(int /*descriptor*/, std::size_t length, std::uint32_t offset) noexcept override {
    void* const memory = mmap(nullptr, length, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) return nullptr;
    const std::lock_guard lock(mutex_);
    buffers_[offset].data = static_cast<std::uint8_t*>(memory);
    return memory;
  }

 private:
  struct Buffer {
    std::uint8_t* data = nullptr;
    bool queued = false;
  };
  struct Injected {
    std::vector<std::uint8_t> bytes;
    std::uint32_t flags = 0;
    std::uint32_t sequence = 0;
  };

  int agree(v4l2_pix_format& format) const noexcept {
    if (format.pixelformat != V4L2_PIX_FMT_MJPEG) return -EINVAL;
    format.bytesperline = 0;
    format.sizeimage = buffer_size_;
    return 0;
  }
  /// A buffer that is too short is refused, as the kernel does.
  int take(const v4l2_buffer& buffer) {
    if (buffer.index >= buffers_.size()) return -EINVAL;
    Buffer& place = buffers_[buffer.index];
    if (buffer.memory == V4L2_MEMORY_USERPTR) {
      if (buffer.length < buffer_size_) return -EINVAL;
      place.data = reinterpret_cast<std::uint8_t*>(buffer.m.userptr);
    }
    place.queued = true;
    given_.push_back(place.data);
    return 0;
  }
  int fill(v4l2_buffer& buffer) {
    const auto place =
        std::find_if(buffers_.begin(), buffers_.end(), [](const Buffer& each) { return each.queued; });
    if (waiting_.empty() || place == buffers_.end()) return -EAGAIN;
    const Injected& next = waiting_.front();
    std::copy(next.bytes.begin(), next.bytes.end(), place->data);
    place->queued = false;
    buffer.index = static_cast<std::uint32_t>(place - buffers_.begin());
    buffer.bytesused = static_cast<std::uint32_t>(next.bytes.size());
    buffer.flags = next.flags;
    buffer.sequence = next.sequence;
    waiting_.erase(waiting_.begin());
    return 0;
  }

  std::uint32_t buffer_size_;
  std::mutex mutex_;  // the camera's thread and its keeper
  std::uint32_t sequence_ = 0;
  std::vector<Buffer> buffers_;
  std::vector<Injected> waiting_;
  std::vector<const std::uint8_t*> given_;
};

}  // namespace flexrf
