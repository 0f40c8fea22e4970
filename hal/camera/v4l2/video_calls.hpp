// VideoCalls: what the driver asks of the kernel, so that a test can make the kernel refuse.
#pragma once

#include <cstddef>
#include <cstdint>

namespace flexrf {

/// The kernel's own. Any thread; open and control may block, but for VIDIOC_QBUF and VIDIOC_DQBUF.
class VideoCalls {
 public:
  virtual ~VideoCalls() = default;

  /// Not blocking; a descriptor, else −errno.
  virtual int open(const char* path) noexcept;
  /// ioctl(), again when a signal came in between; 0 or more, else −errno.
  virtual int control(int descriptor, unsigned long request, void* argument) noexcept;
  /// Null when it cannot.
  virtual void* map(int descriptor, std::size_t length, std::uint32_t offset) noexcept;
};

}  // namespace flexrf
