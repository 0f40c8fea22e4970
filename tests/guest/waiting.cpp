#include "tests/guest/waiting.hpp"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "tests/cmocka.hpp"

namespace flexrf {

int open_device(const char* path) {
  const int descriptor = ::open(path, O_RDWR | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
  if (descriptor < 0) fail_msg("%s: %s", path, std::strerror(errno));
  return descriptor;
}

void await_input(int descriptor) {
  constexpr int limit = 30'000;  // ms
  pollfd wanted = {.fd = descriptor, .events = POLLIN | POLLPRI, .revents = 0};
  if (::poll(&wanted, 1, limit) != 1) fail_msg("nothing came within %d ms", limit);
}

void read_exactly(int descriptor, void* into, unsigned long bytes) {
  for (unsigned long held = 0; held < bytes;) {
    await_input(descriptor);
    const ssize_t got = ::read(descriptor, static_cast<char*>(into) + held, bytes - held);
    if (got <= 0) fail_msg("reading: %s", got == 0 ? "end of file" : std::strerror(errno));
    held += static_cast<unsigned long>(got);
  }
}

}  // namespace flexrf
