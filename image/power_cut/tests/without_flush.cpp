// A library that is loaded before a program of the image (LD_PRELOAD) and leaves out its flushes of one file
// or folder: those whose path matches the pattern in FLEXRF_WITHOUT_FLUSH. The test of power cuts has to find
// what is lost then.
#include <fnmatch.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>

namespace {

bool is_left_out(int descriptor) {
  const char* const pattern = std::getenv("FLEXRF_WITHOUT_FLUSH");
  if (pattern == nullptr) return false;
  std::array<char, 32> link{};
  std::array<char, 4096> path{};
  std::snprintf(link.data(), link.size(), "/proc/self/fd/%d", descriptor);
  return readlink(link.data(), path.data(), path.size() - 1) > 0 && fnmatch(pattern, path.data(), 0) == 0;
}

int flush(long call, int descriptor) {
  return is_left_out(descriptor) ? 0 : static_cast<int>(syscall(call, descriptor));
}

}  // namespace

extern "C" int fsync(int descriptor) {
  return flush(SYS_fsync, descriptor);
}

extern "C" int fdatasync(int descriptor) {
  return flush(SYS_fdatasync, descriptor);
}
