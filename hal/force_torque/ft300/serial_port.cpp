#include "hal/force_torque/ft300/serial_port.hpp"

#include <fcntl.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace flexrf {
namespace {

Status failure(const char* device, int error) {
  if (error == EACCES || error == EPERM) {
    return Status::error(StatusCode::not_permitted,
                         "no permission to open the serial line %s: add this user to the group dialout",
                         device);
  }
  if (error == EBUSY) {
    return Status::error(StatusCode::busy,
                         "the serial line %s is in use by another program; end that program", device);
  }
  if (error == ENOTTY) {
    return Status::error(StatusCode::invalid_argument,
                         "%s is no serial line; /dev/serial/by-id shows those there are", device);
  }
  return Status::error(
      StatusCode::unavailable,
      "the serial line %s cannot be opened: %s; is the adapter plugged in, and the name right (see "
      "/dev/serial/by-id)?",
      device, std::strerror(error));
}

}  // namespace

Status SerialPort::open(const char* device) {
  close();
  descriptor_ = ::open(device, O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  termios settings{};
  if (descriptor_ < 0 || tcgetattr(descriptor_, &settings) != 0) {
    const int error = errno;
    close();
    return failure(device, error);
  }
  cfmakeraw(&settings);
  settings.c_cflag |= CLOCAL | CREAD;
  settings.c_cflag &= ~static_cast<tcflag_t>(CSTOPB | PARENB | CRTSCTS);
  settings.c_cc[VMIN] = 1;
  settings.c_cc[VTIME] = 0;
  cfsetspeed(&settings, B19200);
  if (tcsetattr(descriptor_, TCSANOW, &settings) != 0) {
    const int error = errno;
    close();
    return failure(device, error);
  }
  static_cast<void>(ioctl(descriptor_, TIOCEXCL));
  tcflush(descriptor_, TCIOFLUSH);
  return {};
}

void SerialPort::close() noexcept {
  if (descriptor_ >= 0) {
    // While something else holds a line, as a simulator does its pseudo-terminal, it would stay exclusive,
    // and refuse this user too.
    static_cast<void>(ioctl(descriptor_, TIOCNXCL));
    ::close(descriptor_);
  }
  descriptor_ = -1;
}

int SerialPort::read(std::span<std::uint8_t> buffer) noexcept {
  const ssize_t size = ::read(descriptor_, buffer.data(), buffer.size());
  if (size > 0) return static_cast<int>(size);
  return size < 0 && (errno == EAGAIN || errno == EINTR) ? 0 : -1;
}

void SerialPort::write(std::span<const std::uint8_t> bytes) noexcept {
  static_cast<void>(!::write(descriptor_, bytes.data(), bytes.size()));
}

}  // namespace flexrf
