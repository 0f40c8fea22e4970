#include "hal/modbus/link/simulator/pseudo_serial_line.hpp"

#include <fcntl.h>
#include <termios.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>

namespace flexrf {

Status PseudoSerialLine::open() {
  close();
  char name[64] = "";
  near_ = posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
  if (near_ >= 0 && grantpt(near_) == 0 && unlockpt(near_) == 0 && ptsname_r(near_, name, sizeof(name)) == 0)
    far_ = ::open(name, O_RDWR | O_NOCTTY | O_CLOEXEC);
  termios settings{};
  if (far_ < 0 || tcgetattr(far_, &settings) != 0) {
    const Status status = Status::error(StatusCode::unavailable, "there is no pseudo-terminal to be had: %s",
                                        std::strerror(errno));
    close();
    return status;
  }
  cfmakeraw(&settings);
  tcsetattr(far_, TCSANOW, &settings);
  path_ = name;
  return {};
}

void PseudoSerialLine::close() noexcept {
  for (int* descriptor : {&far_, &near_}) {
    if (*descriptor >= 0) ::close(*descriptor);
    *descriptor = -1;
  }
}

}  // namespace flexrf
