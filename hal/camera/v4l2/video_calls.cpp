#include "hal/camera/v4l2/video_calls.hpp"

#include <fcntl.h>
#include <sys/ioctl.h>
#include <sys/mman.h>

#include <cerrno>

namespace flexrf {

int VideoCalls::open(const char* path) noexcept {
  const int descriptor = ::open(path, O_RDWR | O_NONBLOCK | O_CLOEXEC);
  return descriptor < 0 ? -errno : descriptor;
}

int VideoCalls::control(int descriptor, unsigned long request, void* argument) noexcept {
  while (true) {
    const int result = ::ioctl(descriptor, request, argument);
    if (result >= 0) return result;
    if (errno != EINTR) return -errno;
  }
}

void* VideoCalls::map(int descriptor, std::size_t length, std::uint32_t offset) noexcept {
  void* const memory = ::mmap(nullptr, length, PROT_READ, MAP_SHARED, descriptor, offset);
  return memory == MAP_FAILED ? nullptr : memory;
}

}  // namespace flexrf
