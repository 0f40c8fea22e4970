// VideoSession: a camera that streams, into buffers of the reader's or of the kernel's.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <string>

#include "base/time.hpp"
#include "hal/camera/v4l2/picture_clock.hpp"
#include "hal/camera/v4l2/video_device.hpp"
#include "types/camera_frame.hpp"

namespace flexrf {

struct VideoRequest {
  const char* name = "";  ///< of whom asks, for the log; lives for ever
  std::string device;
  VideoFormat format;
  std::string controls;
  std::span<CameraFrame* const> buffers;  ///< for the kernel to fill, or null; empty: it has its own
  std::size_t room = 0;                   ///< bytes that the item a picture goes to has; 0: it goes to none
};

/// A picture, or what came instead of one.
struct VideoPicture {
  std::uint32_t index = 0;     ///< of its buffer
  std::uint32_t sequence = 0;  ///< the camera's
  std::uint32_t bytes = 0;
  const char* damage = nullptr;  ///< null: it is whole; lives for ever
  PictureStamp stamp;
};

class VideoSession {
 public:
  static constexpr std::size_t most_buffers = 32;  // the kernel's limit

  /// Opens the camera, agrees on the format, sets the controls and lets it stream. Where its driver refuses
  /// the caller's buffers, into the kernel's: see has_user_pointers(). Blocks, allocates.
  static Result<std::unique_ptr<VideoSession>> begin(VideoCalls& calls, const VideoRequest& request);
  VideoSession(const VideoSession&) = delete;
  VideoSession& operator=(const VideoSession&) = delete;
  /// The kernel lets go of all buffers. Blocks.
  ~VideoSession();

  // ---- the camera's thread; neither blocks nor allocates

  int descriptor() const noexcept { return device_.descriptor(); }
  /// 1: a picture, whose buffer is the caller's until it is given back; 0: there is none; else −errno.
  int take(VideoPicture& picture) noexcept;
  /// Gives a buffer of the kernel's back, or one of the caller's to be filled. 0, else −errno.
  int give(std::uint32_t index) noexcept;
  int give(CameraFrame& frame) noexcept;
  /// Of a picture that was taken.
  std::span<const std::uint8_t> mapped(std::uint32_t index) const noexcept { return maps_[index]; }
  CameraFrame* filled(std::uint32_t index) const noexcept { return frames_[index]; }

  bool has_user_pointers() const noexcept { return user_pointers_; }
  const VideoFormat& format() const noexcept { return format_; }
  /// When the stream began, CLOCK_MONOTONIC.
  Time began() const noexcept { return began_; }

  // ---- who began it, beside the camera's thread

  VideoDevice& device() noexcept { return device_; }
  /// What of the controls could not be set at the beginning, or else is to be known of its pictures.
  Status trouble() const { return with_pictures(controls_trouble_); }
  /// Sets them; what could not be, or else is to be known of its pictures.
  Status set_controls(std::string_view text) { return with_pictures(device_.set_controls(text)); }

 private:
  explicit VideoSession(VideoCalls& calls) noexcept : device_(calls) {}
  Status stream(const VideoRequest& request);
  int use_frames(std::span<CameraFrame* const> frames) noexcept;
  int use_maps() noexcept;
  Status with_pictures(const Status& controls) const;
  int ask_for(std::uint32_t memory, std::uint32_t count) noexcept;
  void let_go() noexcept;
  std::uint32_t memory() const noexcept;
  void judge(VideoPicture& picture) const noexcept;

  VideoDevice device_;
  VideoFormat format_;
  Status controls_trouble_;
  std::size_t room_ = 0;
  bool user_pointers_ = false;
  bool streaming_ = false;
  Time began_{};
  std::uint32_t count_ = 0;  // of buffers that the kernel knows
  std::array<CameraFrame*, most_buffers> frames_{};
  std::array<std::span<const std::uint8_t>, most_buffers> maps_{};
  std::array<bool, most_buffers> queued_{};
};

}  // namespace flexrf
