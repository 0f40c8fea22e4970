#include "benchmarks/panel_load/recording.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>

namespace flexrf {

Result<Recording*> open_recording() noexcept {
  static Recording unread{};
  const char* const path = std::getenv(Recording::variable);
  if (path == nullptr) return &unread;
  const int file = open(path, O_RDWR | O_CLOEXEC);
  void* memory = MAP_FAILED;
  if (file >= 0) memory = mmap(nullptr, sizeof(Recording), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  const int error = errno;
  if (file >= 0) close(file);
  if (memory == MAP_FAILED) {
    return Status::error(StatusCode::unavailable, "%s=%s: %s", Recording::variable, path,
                         std::strerror(error));
  }
  return static_cast<Recording*>(memory);
}

}  // namespace flexrf
