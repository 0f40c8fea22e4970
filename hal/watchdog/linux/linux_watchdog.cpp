#include "hal/watchdog/linux/linux_watchdog.hpp"

#include <fcntl.h>
#include <linux/watchdog.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>

#include "runtime/log/log.hpp"

namespace flexrf {
namespace {

/// s. A thread that is not real-time cannot promise to feed it more often than twice a second, and the
/// supervising thread's judgement is up to a second old.
constexpr int least_timeout = 2;

Status cannot_open(const char* path, int error) {
  switch (error) {
    case EBUSY:
      return Status::error(StatusCode::busy,
                           "watchdog %s is in use: by systemd (RuntimeWatchdogSec in system.conf), by "
                           "watchdog(8), or by another application; only one can feed it",
                           path);
    case EACCES:
    case EPERM:
      return Status::error(StatusCode::not_permitted,
                           "no permission to open watchdog %s: give this user the right with a udev rule "
                           "(docs/devices/watchdog.md)",
                           path);
    case ENOENT:
    case ENODEV:
    case ENXIO:
      return Status::error(StatusCode::unavailable,
                           "there is no watchdog %s; is its kernel module loaded? wdctl shows those that are "
                           "there, and softdog is one without hardware",
                           path);
    default:
      return Status::error(StatusCode::unavailable, "watchdog %s cannot be opened: %s", path,
                           std::strerror(error));
  }
}

}  // namespace

LinuxWatchdog::~LinuxWatchdog() {
  let_go(false);
}

void LinuxWatchdog::stop() {
  let_go(!configuration.leave_armed);
  feedback.armed = feedback.armed && configuration.leave_armed;
}

void LinuxWatchdog::let_go(bool disarm) noexcept {
  if (descriptor_ < 0) return;
  // The one byte that says that closing it is meant, and no accident.
  if (disarm && write(descriptor_, "V", 1) != 1)
    log_error(name(), "the watchdog cannot be disarmed: {}", std::string_view{std::strerror(errno)});
  close(descriptor_);
  descriptor_ = -1;
}

Status LinuxWatchdog::arm() {
  let_go(true);
  const std::string path{text_view(configuration.device)};
  // From here on it counts.
  descriptor_ = open(path.c_str(), O_WRONLY | O_CLOEXEC);
  if (descriptor_ < 0) return cannot_open(path.c_str(), errno);
  const Status status = set_up(path.c_str());
  if (!status) let_go(true);
  return status;
}

Status LinuxWatchdog::set_up(const char* path) {
  watchdog_info information{};
  if (ioctl(descriptor_, WDIOC_GETSUPPORT, &information) < 0) {
    const int error = errno;
    close(descriptor_);  // nothing is written to what is no watchdog
    descriptor_ = -1;
    return Status::error(StatusCode::invalid_argument,
                         "%s is no watchdog (%s): name one that wdctl shows, as /dev/watchdog", path,
                         std::strerror(error));
  }
  if (const Status status = set_timeout(path); !status) return status;
  int why = 0;
  feedback.caused_last_reset =
      ioctl(descriptor_, WDIOC_GETBOOTSTATUS, &why) == 0 && (why & WDIOF_CARDRESET) != 0;
  if (feedback.caused_last_reset)
    log_warning(name(), "the machine's last reset was this watchdog's: it had not been fed");
  if (configuration.pretimeout > 0) {
    if ((information.options & WDIOF_PRETIMEOUT) != 0) {
      set_pretimeout(path);
    } else {
      log_warning(name(), "{} gives no warning before the reset: pretimeout is without effect",
                  std::string_view{path});
    }
  }
  if ((information.options & WDIOF_MAGICCLOSE) == 0 && !configuration.leave_armed)
    log_warning(name(), "{} cannot be disarmed: the machine is reset after the application's end",
                std::string_view{path});
  if (ioctl(descriptor_, WDIOC_KEEPALIVE, nullptr) == 0) return {};
  return Status::error(StatusCode::unavailable, "watchdog %s cannot be fed: %s", path, std::strerror(errno));
}

Status LinuxWatchdog::set_timeout(const char* path) {
  const auto asked = static_cast<int>(configuration.timeout);
  int in_force = asked;
  if (ioctl(descriptor_, WDIOC_SETTIMEOUT, &in_force) < 0) {
    const int error = errno;
    if (error == EINVAL) {
      return Status::error(StatusCode::out_of_range,
                           "timeout: watchdog %s does not take %d s; wdctl shows what it has, and "
                           "/sys/class/watchdog/*/max_timeout, where it is, its longest",
                           path, asked);
    }
    log_warning(name(), "the time-out of {} cannot be set: {}", std::string_view{path},
                std::string_view{std::strerror(error)});
  }
  if (ioctl(descriptor_, WDIOC_GETTIMEOUT, &in_force) < 0) {
    return Status::error(StatusCode::unavailable, "watchdog %s does not say its time-out: %s", path,
                         std::strerror(errno));
  }
  if (in_force < least_timeout) {
    return Status::error(StatusCode::out_of_range,
                         "watchdog %s resets the machine after %d s: sooner than a thread that is not "
                         "real-time can promise to feed it; it must be %d s or more",
                         path, in_force, least_timeout);
  }
  if (in_force != asked)
    log_warning(name(), "{} resets the machine after {} s, not {} s", std::string_view{path}, in_force,
                asked);
  feedback.timeout = static_cast<std::uint32_t>(in_force);
  return {};
}

void LinuxWatchdog::set_pretimeout(const char* path) {
  auto value = static_cast<int>(configuration.pretimeout);
  if (ioctl(descriptor_, WDIOC_SETPRETIMEOUT, &value) < 0) {
    log_warning(name(), "{} does not take a pretimeout of {} s: {}", std::string_view{path}, value,
                std::string_view{std::strerror(errno)});
  }
  if (ioctl(descriptor_, WDIOC_GETPRETIMEOUT, &value) < 0) value = 0;
  feedback.pretimeout = static_cast<std::uint32_t>(value);
}

bool LinuxWatchdog::feed(Time /*now*/) noexcept {
  if (ioctl(descriptor_, WDIOC_KEEPALIVE, nullptr) == 0) return true;
  fail(Status::error(StatusCode::unavailable,
                     "the watchdog cannot be fed: %s; it may reset the machine within %u s",
                     std::strerror(errno), feedback.timeout));
  return false;
}

}  // namespace flexrf
