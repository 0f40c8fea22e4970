#include "hal/camera/v4l2/video_session.hpp"

#include <linux/videodev2.h>
#include <sys/mman.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "hal/camera/interface/jpeg_check.hpp"
#include "hal/camera/interface/picture_size.hpp"
#include "runtime/log/log.hpp"

namespace flexrf {
namespace {

constexpr std::uint32_t mapped_buffers = 4;
constexpr std::uint32_t fewest_buffers = 2;

/// A buffer's number and where it lies, as both interfaces of the kernel have them.
struct VideoBuffer {
  v4l2_buffer buffer{};
  v4l2_plane plane{};  // of a device that describes its buffers by planes
  bool planes = false;

  VideoBuffer(const VideoDevice& device, std::uint32_t memory, std::uint32_t index) noexcept
      : planes(device.has_planes()) {
    buffer.type = device.buffer_type();
    buffer.memory = memory;
    buffer.index = index;
    if (!planes) return;
    buffer.m.planes = &plane;
    buffer.length = 1;
  }
  VideoBuffer(const VideoBuffer&) = delete;
  VideoBuffer& operator=(const VideoBuffer&) = delete;

  void set_memory(std::span<std::uint8_t> data) noexcept {
    const auto address = reinterpret_cast<unsigned long>(data.data());
    if (planes) {
      plane.m.userptr = address;
      plane.length = static_cast<std::uint32_t>(data.size());
    } else {
      buffer.m.userptr = address;
      buffer.length = static_cast<std::uint32_t>(data.size());
    }
  }
  std::uint32_t length() const noexcept { return planes ? plane.length : buffer.length; }
  std::uint32_t offset() const noexcept { return planes ? plane.m.mem_offset : buffer.m.offset; }
  std::uint32_t bytes() const noexcept { return planes ? plane.bytesused : buffer.bytesused; }
  /// Where in it the picture begins; its bytes count from the buffer's beginning.
  std::uint32_t begin() const noexcept { return planes ? plane.data_offset : 0; }
};

PictureStamp stamp_of(const v4l2_buffer& buffer) noexcept {
  // A copied stamp is somebody else's, an unknown one by any clock.
  if ((buffer.flags & V4L2_BUF_FLAG_TIMESTAMP_MASK) != V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC) return {};
  const auto since =
      std::chrono::seconds(buffer.timestamp.tv_sec) + std::chrono::microseconds(buffer.timestamp.tv_usec);
  const bool begins = (buffer.flags & V4L2_BUF_FLAG_TSTAMP_SRC_MASK) == V4L2_BUF_FLAG_TSTAMP_SRC_SOE;
  return {begins ? StampSource::begin_of_exposure : StampSource::end_of_frame, Time{since}};
}

/// Bytes that a whole picture has at least; the last row may lack its padding.
std::size_t whole_size(const VideoFormat& format) noexcept {
  return std::size_t{format.stride} * (data_rows(format.format, format.height) - 1) +
         row_bytes(format.format, format.width);
}

}  // namespace

Result<std::unique_ptr<VideoSession>> VideoSession::begin(VideoCalls& calls, const VideoRequest& request) {
  std::unique_ptr<VideoSession> session(new VideoSession(calls));
  session->format_ = request.format;
  session->room_ = request.room;
  if (Status status = session->device_.open(request.device); !status) return status;
  session->device_.find_controls();
  if (Status status = session->device_.agree(session->format_, request.room); !status) return status;
  if (Status status = check_settings(session->device_.controls(), request.controls); !status) return status;
  session->controls_trouble_ = session->device_.set_controls(request.controls);
  if (Status status = session->stream(request); !status) return status;
  return session;
}

Status VideoSession::with_pictures(const Status& controls) const {
  if (!controls.is_ok() || !format_.interlaced) return controls;
  return Status::error(StatusCode::device_fault,
                       "the camera %s is interlaced: every other row is of another time, and what moves has "
                       "combed edges; ask for a size or input without (progressive), if it has one",
                       device_.path());
}

VideoSession::~VideoSession() {
  let_go();
}

std::uint32_t VideoSession::memory() const noexcept {
  return user_pointers_ ? V4L2_MEMORY_USERPTR : V4L2_MEMORY_MMAP;
}

Status VideoSession::stream(const VideoRequest& request) {
  int result = -EINVAL;
  if (!request.buffers.empty() && format_.size > room_) {
    log_warning(
        request.name,
        "the camera wants buffers of {} bytes, an item of its slot has {}: every picture is copied once; "
        "with elements = {} in the row of the slot none is",
        format_.size, room_, format_.size);
  } else if (!request.buffers.empty()) {
    result = use_frames(request.buffers);
    if (result == -EBUSY || result == -ENODEV) return video_error(result, device_.path(), "stream");
    if (result < 0) {
      log_warning(request.name,
                  "the kernel's driver {} does not fill buffers of others ({}): every picture is copied once",
                  std::string_view(device_.driver()), std::string_view(std::strerror(-result)));
      let_go();
    }
  }
  if (result < 0) result = use_maps();
  auto type = static_cast<int>(device_.buffer_type());
  began_ = MonotonicClock::now();
  if (result >= 0) result = device_.calls().control(descriptor(), VIDIOC_STREAMON, &type);
  if (result < 0) return video_error(result, device_.path(), "stream");
  streaming_ = true;
  return {};
}

/// A buffer of the caller's has an index of the kernel's for as long as the session lasts, so that its pages
/// are looked up but once.
int VideoSession::use_frames(std::span<CameraFrame* const> frames) noexcept {
  user_pointers_ = true;
  int result = ask_for(V4L2_MEMORY_USERPTR, most_buffers);
  for (CameraFrame* const frame : frames)
    if (frame != nullptr && result >= 0) result = give(*frame);
  return result;
}

int VideoSession::use_maps() noexcept {
  user_pointers_ = false;
  int result = ask_for(V4L2_MEMORY_MMAP, mapped_buffers);
  for (std::uint32_t index = 0; index < count_ && result >= 0; ++index) {
    VideoBuffer place(device_, V4L2_MEMORY_MMAP, index);
    result = device_.calls().control(descriptor(), VIDIOC_QUERYBUF, &place.buffer);
    if (result < 0) break;
    void* const memory = device_.calls().map(descriptor(), place.length(), place.offset());
    if (memory == nullptr) return -ENOMEM;
    maps_[index] = {static_cast<const std::uint8_t*>(memory), place.length()};
    result = give(index);
  }
  return result;
}

int VideoSession::ask_for(std::uint32_t memory, std::uint32_t count) noexcept {
  v4l2_requestbuffers buffers{};
  buffers.count = count;
  buffers.type = device_.buffer_type();
  buffers.memory = memory;
  const int result = device_.calls().control(descriptor(), VIDIOC_REQBUFS, &buffers);
  if (result < 0) return result;
  count_ = std::min<std::uint32_t>(buffers.count, most_buffers);
  return count_ < fewest_buffers ? -ENOMEM : 0;
}

void VideoSession::let_go() noexcept {
  auto type = static_cast<int>(device_.buffer_type());
  VideoCalls& calls = device_.calls();
  // Each may fail with a camera that is gone; closing it does the same then.
  if (streaming_) static_cast<void>(calls.control(descriptor(), VIDIOC_STREAMOFF, &type));
  streaming_ = false;
  for (std::span<const std::uint8_t>& map : maps_) {
    if (!map.empty()) munmap(const_cast<std::uint8_t*>(map.data()), map.size());
    map = {};
  }
  v4l2_requestbuffers none{};
  none.type = device_.buffer_type();
  none.memory = memory();
  if (count_ > 0) static_cast<void>(calls.control(descriptor(), VIDIOC_REQBUFS, &none));
  count_ = 0;
  frames_ = {};
  queued_ = {};
}

int VideoSession::take(VideoPicture& picture) noexcept {
  VideoBuffer taken(device_, memory(), 0);
  const v4l2_buffer& buffer = taken.buffer;
  const int result = device_.calls().control(descriptor(), VIDIOC_DQBUF, &taken.buffer);
  if (result == -EAGAIN) return 0;
  if (result < 0) return result;
  if (buffer.index >= count_) return -EIO;
  queued_[buffer.index] = false;
  picture.index = buffer.index;
  picture.sequence = buffer.sequence;
  picture.bytes = taken.bytes();
  picture.damage = (buffer.flags & V4L2_BUF_FLAG_ERROR) != 0 ? "marked as damaged by the kernel"
                   : taken.begin() != 0                      ? "it does not begin with its buffer"
                                                             : nullptr;
  if (picture.damage == nullptr) judge(picture);
  picture.stamp = stamp_of(buffer);
  return 1;
}

/// Whether as much came as is a picture; and of one that is compressed, where it ends.
void VideoSession::judge(VideoPicture& picture) const noexcept {
  if (format_.format != PixelFormat::mjpeg) {
    if (picture.bytes < whole_size(format_)) picture.damage = "too short";
    picture.bytes = std::min(picture.bytes, format_.size);
    return;
  }
  const std::span<const std::uint8_t> data =
      user_pointers_ ? frames_[picture.index]->data() : maps_[picture.index];
  const CheckedJpeg checked = check_jpeg(data.first(std::min<std::size_t>(picture.bytes, data.size())),
                                         format_.width, format_.height);
  picture.bytes = static_cast<std::uint32_t>(checked.size);
  picture.damage = room_ > 0 && checked.size > room_
                       ? "it does not fit an item: its slot's row says too few elements"
                       : checked.damage;
}

int VideoSession::give(std::uint32_t index) noexcept {
  VideoBuffer given(device_, memory(), index);
  if (user_pointers_) given.set_memory(frames_[index]->data());
  const int result = device_.calls().control(descriptor(), VIDIOC_QBUF, &given.buffer);
  if (result >= 0) queued_[index] = true;
  return result < 0 ? result : 0;
}

int VideoSession::give(CameraFrame& frame) noexcept {
  std::uint32_t index = 0;
  while (index < count_ && frames_[index] != &frame && frames_[index] != nullptr) ++index;
  if (index == count_) {
    // More buffers than the kernel has places for: another's place, and its pages are looked up again.
    index = 0;
    while (index < count_ && queued_[index]) ++index;
    if (index == count_) return -ENOMEM;
  }
  frames_[index] = &frame;
  return give(index);
}

}  // namespace flexrf
