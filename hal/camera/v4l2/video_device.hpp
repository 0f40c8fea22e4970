// VideoDevice: an opened camera: what it is, what it gives, what can be set. All of it may block and
// allocate: not for a cyclic thread.
#pragma once

#include <array>
#include <span>
#include <string>

#include "hal/camera/interface/camera_controls.hpp"
#include "hal/camera/v4l2/video_calls.hpp"
#include "types/pixel_format.hpp"

struct v4l2_query_ext_ctrl;

namespace flexrf {

/// What is asked of a camera, and what it agreed to.
struct VideoFormat {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  PixelFormat format = PixelFormat::none;
  double frame_rate = 0;     ///< 1/s
  bool interlaced = false;   ///< agreed: every other row is of another time
  std::uint32_t stride = 0;  ///< agreed: bytes from row to row
  std::uint32_t size = 0;    ///< agreed: bytes of a buffer
};

class VideoDevice {
 public:
  static constexpr std::size_t most_controls = 24;  // as feedback has

  explicit VideoDevice(VideoCalls& calls) noexcept : calls_(&calls) {}
  VideoDevice(const VideoDevice&) = delete;
  VideoDevice& operator=(const VideoDevice&) = delete;
  ~VideoDevice();

  /// `name`: a path, or a name as in /sys/class/video4linux/*/name. Errors: unavailable (it is not there),
  /// busy, not_permitted, invalid_argument (not a camera).
  Status open(const std::string& name);
  /// Errors: busy; invalid_argument, with what it offers instead, or of fields that come one after the other.
  Status agree(VideoFormat& format, std::size_t room);
  /// Of its buffers, V4L2_BUF_TYPE_...
  std::uint32_t buffer_type() const noexcept { return buffer_type_; }
  /// Its buffers are described by planes; those of all our formats have one.
  bool has_planes() const noexcept;
  /// Finds out what can be set; then it is known to controls().
  void find_controls();
  std::span<const CameraControl> controls() const noexcept { return {controls_.data(), count_}; }
  /// All that a text says, in its order, and asks for the values in force; the first error, if any.
  Status set_controls(std::string_view text);

  int descriptor() const noexcept { return descriptor_; }
  const char* path() const noexcept { return path_.c_str(); }
  const char* driver() const noexcept { return driver_.data(); }
  VideoCalls& calls() const noexcept { return *calls_; }

 private:
  Status open_path(const char* path);
  void close() noexcept;
  int propose(VideoFormat& format, std::uint32_t& field) noexcept;
  std::string offers(PixelFormat asked);
  std::string sizes_of(std::uint32_t pixel_format);
  void add(const v4l2_query_ext_ctrl& found);
  void look_at(std::size_t index) noexcept;

  VideoCalls* calls_;
  std::string path_;
  std::array<char, 17> driver_{};
  int descriptor_ = -1;
  std::uint32_t buffer_type_ = 0;
  std::array<CameraControl, most_controls> controls_{};
  std::array<std::uint32_t, most_controls> identifiers_{};
  std::size_t count_ = 0;
};

/// Zero and below: an error of the kernel's. What a person reads of it, and can do.
Status video_error(int error, const char* path, const char* what);

}  // namespace flexrf
