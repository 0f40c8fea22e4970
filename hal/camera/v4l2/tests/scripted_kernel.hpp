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
#include <utility>
#include <vector>

#include "base/time.hpp"
#include "hal/camera/v4l2/video_calls.hpp"

namespace flexrf {

/// What the camera is.
struct ScriptedCamera {
  std::vector<std::uint32_t> formats = {V4L2_PIX_FMT_MJPEG};  ///< the first, where it is asked for another
  std::uint32_t field = V4L2_FIELD_NONE;
  std::uint8_t planes = 0;        ///< 0: it knows of none (V4L2_CAP_VIDEO_CAPTURE), else of each picture
  std::uint32_t data_offset = 0;  ///< of a plane
};

class ScriptedKernel final : public VideoCalls {
 public:
  explicit ScriptedKernel(std::uint32_t buffer_size, ScriptedCamera camera = {})
      : buffer_size_(buffer_size), camera_(std::move(camera)) {}

  /// The next picture, as it lies in the buffer that the driver takes.
  void inject(std::span<const std::uint8_t> bytes, std::uint32_t flags = 0, Time stamp = {}) {
    const std::lock_guard lock(mutex_);
    waiting_.push_back({{bytes.begin(), bytes.end()}, flags, sequence_++, stamp});
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
        static_cast<v4l2_capability*>(argument)->capabilities =
            (camera_.planes > 0 ? V4L2_CAP_VIDEO_CAPTURE_MPLANE : V4L2_CAP_VIDEO_CAPTURE) |
            V4L2_CAP_STREAMING;
        return 0;
      case VIDIOC_ENUM_FMT:
        return enumerate(*static_cast<v4l2_fmtdesc*>(argument));
      case VIDIOC_S_FMT:
        return agree(*static_cast<v4l2_format*>(argument));
      case VIDIOC_S_PARM:
        return is_ours(static_cast<const v4l2_streamparm*>(argument)->type);
      case VIDIOC_STREAMON:
      case VIDIOC_STREAMOFF:
        return is_ours(*static_cast<const std::uint32_t*>(argument));
      case VIDIOC_REQBUFS:
        if (const int error = is_ours(static_cast<v4l2_requestbuffers*>(argument)->type)) return error;
        buffers_.resize(std::max<std::size_t>(buffers_.size(), 4));
        static_cast<v4l2_requestbuffers*>(argument)->count = 4;
        return 0;
      case VIDIOC_QUERYBUF:
        return tell(*static_cast<v4l2_buffer*>(argument));
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
    Time stamp{};
  };

  /// As the kernel: a buffer's type is that of the camera, and its planes are described where it has any.
  int is_ours(std::uint32_t type) const noexcept {
    return type == (camera_.planes > 0 ? V4L2_BUF_TYPE_VIDEO_CAPTURE_MPLANE : V4L2_BUF_TYPE_VIDEO_CAPTURE)
               ? 0
               : -EINVAL;
  }
  int is_ours(const v4l2_buffer& buffer) const noexcept {
    if (const int error = is_ours(buffer.type)) return error;
    return camera_.planes == 0 || (buffer.m.planes != nullptr && buffer.length == camera_.planes) ? 0
                                                                                                  : -EINVAL;
  }
  int enumerate(v4l2_fmtdesc& format) const noexcept {
    if (is_ours(format.type) != 0 || format.index >= camera_.formats.size()) return -EINVAL;
    format.pixelformat = camera_.formats[format.index];
    return 0;
  }
  int agree(v4l2_format& format) const noexcept {
    if (const int error = is_ours(format.type)) return error;
    v4l2_pix_format& plain = format.fmt.pix;
    v4l2_pix_format_mplane& planes = format.fmt.pix_mp;
    const auto given = [this](std::uint32_t asked) {
      const auto& all = camera_.formats;
      return std::find(all.begin(), all.end(), asked) == all.end() ? all.front() : asked;
    };
    if (camera_.planes > 0) {
      planes.pixelformat = given(planes.pixelformat);
      planes.num_planes = camera_.planes;
      planes.field = camera_.field;
      planes.plane_fmt[0] = {};
      planes.plane_fmt[0].sizeimage = buffer_size_;
    } else {
      plain.pixelformat = given(plain.pixelformat);
      plain.bytesperline = 0;
      plain.sizeimage = buffer_size_;
      plain.field = camera_.field;
    }
    return 0;
  }
  int tell(v4l2_buffer& buffer) const noexcept {
    if (const int error = is_ours(buffer)) return error;
    if (camera_.planes > 0) {
      buffer.m.planes[0].length = buffer_size_;
      buffer.m.planes[0].m.mem_offset = buffer.index;
    } else {
      buffer.length = buffer_size_;
      buffer.m.offset = buffer.index;
    }
    return 0;
  }
  /// A buffer that is too short is refused, as the kernel does.
  int take(const v4l2_buffer& buffer) {
    if (buffer.index >= buffers_.size() || is_ours(buffer) != 0) return -EINVAL;
    Buffer& place = buffers_[buffer.index];
    if (buffer.memory == V4L2_MEMORY_USERPTR) {
      const bool planes = camera_.planes > 0;
      if ((planes ? buffer.m.planes[0].length : buffer.length) < buffer_size_) return -EINVAL;
      place.data = reinterpret_cast<std::uint8_t*>(planes ? buffer.m.planes[0].m.userptr : buffer.m.userptr);
    }
    place.queued = true;
    given_.push_back(place.data);
    return 0;
  }
  int fill(v4l2_buffer& buffer) {
    if (const int error = is_ours(buffer)) return error;
    const auto place =
        std::find_if(buffers_.begin(), buffers_.end(), [](const Buffer& each) { return each.queued; });
    if (waiting_.empty() || place == buffers_.end()) return -EAGAIN;
    const Injected& next = waiting_.front();
    std::copy(next.bytes.begin(), next.bytes.end(), place->data);
    place->queued = false;
    buffer.index = static_cast<std::uint32_t>(place - buffers_.begin());
    buffer.bytesused = static_cast<std::uint32_t>(next.bytes.size());
    if (camera_.planes > 0) {
      buffer.m.planes[0].bytesused = buffer.bytesused;
      buffer.m.planes[0].data_offset = camera_.data_offset;
      buffer.bytesused = 0;  // as the kernel leaves it
    }
    buffer.flags = next.flags;
    buffer.sequence = next.sequence;
    const std::int64_t stamp = nanoseconds(next.stamp) / 1000;
    buffer.timestamp = {.tv_sec = stamp / 1'000'000, .tv_usec = stamp % 1'000'000};
    waiting_.erase(waiting_.begin());
    return 0;
  }

  std::uint32_t buffer_size_;
  ScriptedCamera camera_;
  std::mutex mutex_;  // the camera's thread and its keeper
  std::uint32_t sequence_ = 0;
  std::vector<Buffer> buffers_;
  std::vector<Injected> waiting_;
  std::vector<const std::uint8_t*> given_;
};

}  // namespace flexrf
