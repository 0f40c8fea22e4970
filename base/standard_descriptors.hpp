// Standard input, output and error: there from the beginning, whatever whoever started the process has
// closed.
#pragma once

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <climits>
#include <string_view>

namespace flexrf {

/// Opens /dev/null in place of each of the descriptors 0, 1 and 2 that is closed: the next file that is
/// opened would get its number otherwise, be read as input or have the report written into it. The first in
/// main().
inline void hold_standard_descriptors() noexcept {
  for (int descriptor = STDIN_FILENO; descriptor <= STDERR_FILENO; ++descriptor) {
    if (fcntl(descriptor, F_GETFD) >= 0) continue;
    // The lowest number that is free is this one. Not closed when another program is started.
    const int opened =
        open("/dev/null", descriptor == STDIN_FILENO ? O_RDONLY : O_WRONLY);  // NOLINT(android-cloexec-open)
    if (opened >= 0 && opened != descriptor) {
      dup2(opened, descriptor);
      close(opened);
    }
  }
}

/// Writes to standard error what its reader takes at once: nobody waits for who does not read. At most
/// PIPE_BUF bytes, which a pipe with room takes whole. False: it was not taken.
inline bool tell_at_once(std::string_view text) noexcept {
  pollfd errors{STDERR_FILENO, POLLOUT, 0};
  if (text.size() > PIPE_BUF || poll(&errors, 1, 0) <= 0 || (errors.revents & POLLOUT) == 0) return false;
  return write(STDERR_FILENO, text.data(), text.size()) == static_cast<ssize_t>(text.size());
}

}  // namespace flexrf
