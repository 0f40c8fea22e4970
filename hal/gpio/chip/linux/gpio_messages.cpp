#include "hal/gpio/chip/linux/gpio_messages.hpp"

#include <cerrno>
#include <cstring>

namespace flexrf {

Status cannot_open_chip(const char* chip, int error) {
  if (error == EACCES || error == EPERM) {
    return Status::error(StatusCode::not_permitted,
                         "no permission to open GPIO chip %s: give this user the right with a udev rule "
                         "(docs/devices/gpio.md)",
                         chip);
  }
  if (error == ENOENT || error == ENODEV || error == ENXIO) {
    return Status::error(
        StatusCode::unavailable,
        "there is no GPIO chip %s; is it plugged in and its kernel module loaded? gpiodetect "
        "lists those that are there",
        chip);
  }
  return Status::error(StatusCode::unavailable, "GPIO chip %s cannot be opened: %s", chip,
                       std::strerror(error));
}

Status has_no_line(const char* chip, const char* line) {
  return Status::error(StatusCode::not_found,
                       "GPIO chip %s has no line named %s; gpioinfo lists the names, which come from the "
                       "device tree or ACPI. A line without a name is meant by its offset, as \"#3\"",
                       chip, line);
}

Status has_fewer_lines(const char* chip, const char* line, unsigned count) {
  return Status::error(StatusCode::not_found,
                       "GPIO chip %s has no line %s: it has %u, and their offsets begin at 0 (gpioinfo)",
                       chip, line, count);
}

Status is_a_double_name(const char* chip, const char* line, unsigned first, unsigned second) {
  return Status::error(StatusCode::invalid_argument,
                       "GPIO chip %s has two lines named %s, at the offsets %u and %u: name the one that is "
                       "meant by its offset, as \"#%u\"",
                       chip, line, first, second, first);
}

Status cannot_request_line(const char* chip, const char* line, const char* user, int error) {
  if (error == EBUSY) {
    return Status::error(StatusCode::busy,
                         "line %s of GPIO chip %s is in use by %s; end that program, or name another line",
                         line, chip, user == nullptr ? "the kernel or another program" : user);
  }
  if (error == EACCES || error == EPERM) {
    return Status::error(StatusCode::not_permitted,
                         "line %s of GPIO chip %s may not be had in this direction: %s", line, chip,
                         std::strerror(error));
  }
  return Status::error(StatusCode::unavailable, "line %s of GPIO chip %s cannot be had: %s", line, chip,
                       std::strerror(error));
}

}  // namespace flexrf
