#include "hal/operator/evdev/evdev_device.hpp"

#include <fcntl.h>
#include <libevdev/libevdev.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <ctime>
#include <vector>

#include "hal/operator/evdev/evdev_nodes.hpp"

namespace flexrf {
namespace {

const char* words_for(EvdevKind kind) {
  switch (kind) {
    case EvdevKind::keyboard:
      return "keyboard: it has no key of a letter";
    case EvdevKind::pointer:
      return "pointer: it has no relative axes x and y";
    case EvdevKind::joystick:
      return "joystick: it has no axis, or no button of one";
  }
  return "device of this kind";
}

Status cannot_open(const std::string& path, int error) {
  switch (error) {
    case EACCES:
    case EPERM:
      return Status::error(StatusCode::not_permitted,
                           "no permission to open %s: add this user to the group input (sudo usermod -aG "
                           "input NAME) and log in again",
                           path.c_str());
    case ENOENT:
    case ENODEV:
    case ENXIO:
      return Status::error(StatusCode::not_found, "there is no input device %s; is it plugged in?",
                           path.c_str());
    default:
      return Status::error(StatusCode::unavailable, "cannot open %s as an input device: %s", path.c_str(),
                           std::strerror(error));
  }
}

Status no_such_device(const std::string& wanted, const std::vector<EvdevNode>& nodes) {
  std::string names;
  for (const EvdevNode& node : nodes) {
    if (names.find('\'' + node.name + '\'') != std::string::npos) continue;
    names += (names.empty() ? " There are: '" : ", '") + node.name + '\'';
  }
  if (wanted.empty()) {
    return Status::error(StatusCode::invalid_argument,
                         "configuration.device says no input device: a name, vendor:product, phys, or a path "
                         "of /dev/input/by-id.%s",
                         names.c_str());
  }
  return Status::error(StatusCode::not_found, "there is no input device '%s'; is it plugged in?%s",
                       wanted.c_str(), names.c_str());
}

}  // namespace

EvdevDevice::~EvdevDevice() {
  libevdev_free(device_);
  close(descriptor_);
}

Result<std::unique_ptr<EvdevDevice>> EvdevDevice::open(const EvdevRequest& request) {
  if (request.device.starts_with('/')) return open(request.device, request);
  const std::vector<EvdevNode> nodes = list_evdev_nodes();
  std::unique_ptr<EvdevDevice> found;
  Status trouble = no_such_device(request.device, nodes);
  for (const EvdevNode& node : nodes) {
    if (!is_meant(node, request.device)) continue;
    Result<std::unique_ptr<EvdevDevice>> device = open(node.path(), request);
    if (!device) {
      // A mouse may be a keyboard, too, by its other device: that is no reason.
      if (trouble.code() != StatusCode::not_permitted && trouble.code() != StatusCode::busy)
        trouble = device.status();
    } else if (found != nullptr) {
      return Status::error(StatusCode::invalid_argument,
                           "'%s' means %s and %s: name one by its phys, or by a path of /dev/input/by-path",
                           request.device.c_str(), found->path().c_str(), (*device)->path().c_str());
    } else {
      found = std::move(*device);
    }
  }
  if (found == nullptr) return trouble;
  return found;
}

Result<std::unique_ptr<EvdevDevice>> EvdevDevice::open(const std::string& path, const EvdevRequest& request) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0) return cannot_open(path, errno);
  std::unique_ptr<EvdevDevice> device(new EvdevDevice(path, descriptor));
  if (const int result = libevdev_new_from_fd(descriptor, &device->device_); result < 0)
    return cannot_open(path, -result);
  if (!device->is(request.kind)) {
    return Status::error(StatusCode::invalid_argument, "'%s' (%s) is no %s",
                         libevdev_get_name(device->device_), path.c_str(), words_for(request.kind));
  }
  if (const int result = libevdev_set_clock_id(device->device_, CLOCK_MONOTONIC); result < 0)
    return cannot_open(path, -result);
  if (!request.grab) return device;
  const int result = libevdev_grab(device->device_, LIBEVDEV_GRAB);
  if (result == -EBUSY) {
    return Status::error(StatusCode::busy,
                         "'%s' (%s) is grabbed by somebody else; end that program, or do without",
                         libevdev_get_name(device->device_), path.c_str());
  }
  if (result < 0) return cannot_open(path, -result);
  return device;
}

bool EvdevDevice::has(unsigned type, unsigned code) const noexcept {
  return libevdev_has_event_code(device_, type, code) != 0;
}

const input_absinfo* EvdevDevice::axis(unsigned code) const noexcept {
  return libevdev_get_abs_info(device_, code);
}

bool EvdevDevice::is(EvdevKind kind) const noexcept {
  switch (kind) {
    case EvdevKind::keyboard:
      for (const unsigned code : {KEY_A, KEY_W, KEY_SPACE, KEY_ENTER})
        if (has(EV_KEY, code)) return true;
      return false;
    case EvdevKind::pointer:
      return has(EV_REL, REL_X) && has(EV_REL, REL_Y);
    case EvdevKind::joystick:
      for (unsigned code = BTN_JOYSTICK; code < BTN_DIGI; ++code)
        if (has(EV_KEY, code)) return has(EV_ABS, ABS_X) || has(EV_ABS, ABS_RX);
      return false;
  }
  return false;
}

/// As libevdev documents it: after SYN_DROPPED its events are asked for in another way until there are none,
/// and bring the account of what is down and deflected up to date.
int EvdevDevice::next(input_event& event) noexcept {
  if (catching_up_) {
    const int result = libevdev_next_event(device_, LIBEVDEV_READ_FLAG_SYNC, &event);
    if (result != -EAGAIN) return result < 0 ? result : 1;
    catching_up_ = false;
  }
  const int result = libevdev_next_event(device_, LIBEVDEV_READ_FLAG_NORMAL, &event);
  if (result == LIBEVDEV_READ_STATUS_SYNC) {
    catching_up_ = true;
    ++overflows_;
  }
  if (result == -EAGAIN || result == -EINTR) return 0;
  return result < 0 ? result : 1;
}

}  // namespace flexrf
