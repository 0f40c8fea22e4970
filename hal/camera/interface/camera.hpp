// Camera: something that gives pictures.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "camera_interface.hpp"
#include "types/camera_frame.hpp"

namespace flexrf {

/// A picture where it lies, in memory that is the driver's.
struct CameraImage {
  std::span<const std::uint8_t> data;  ///< its rows as in CameraFrame, the last perhaps without its padding;
                                       ///< in mjpeg a JPEG, whole as its markers tell [camera-7]
  std::uint32_t width = 0;             ///< pixels
  std::uint32_t height = 0;            ///< rows
  std::uint32_t stride = 0;            ///< bytes from one row to the next; 0 in mjpeg
  PixelFormat format = PixelFormat::none;
  Time time{};                 ///< the middle of its exposure, on the clock of the cycles
  std::uint64_t sequence = 0;  ///< the camera's count: rises, what is left out was lost [camera-1]
};

/// Two ways to the pictures, and on neither does a processor copy one unless feedback.copied_bytes says so:
///  - with an IO thread each is an item of the slot `frames`, and stays for as long as its reader looks
///    [camera-2];
///  - a camera that belongs to a unit gives the newest by frame() [camera-3].
/// A camera that is not there or goes away is no fault: feedback says what the trouble is, no pictures come,
/// and they come again when it does [camera-4]. Everything but initialise and stop: the thread the camera
/// lives in.
class Camera : public CameraInterface {
 public:
  using CameraInterface::CameraInterface;

  /// The newest picture, if one came since the cycle before; the same all through a cycle, valid until the
  /// next receive() [camera-5]. Nothing while the slot `frames` is connected: they go there
  /// instead [camera-6].
  virtual std::optional<CameraImage> frame() const noexcept = 0;
};

}  // namespace flexrf
