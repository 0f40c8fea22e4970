#include "hal/operator/evdev/tests/uinput_device.hpp"

#include <fcntl.h>
#include <glob.h>
#include <linux/input.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cstdio>
#include <cstring>

namespace flexrf {

void UinputDevice::unplug() {
  if (grabbed_ >= 0) close(grabbed_);
  grabbed_ = -1;
  if (descriptor_ < 0) return;
  ioctl(descriptor_, UI_DEV_DESTROY);
  close(descriptor_);
  descriptor_ = -1;
}

bool UinputDevice::plug_in() {
  unplug();
  descriptor_ = open("/dev/uinput", O_RDWR | O_NONBLOCK | O_CLOEXEC);
  if (descriptor_ < 0 || !describe() || ioctl(descriptor_, UI_DEV_CREATE) != 0) {
    std::perror("uinput");
    return false;
  }
  char device[32] = {};
  if (ioctl(descriptor_, UI_GET_SYSNAME(sizeof(device)), device) < 0) return false;
  const std::string pattern = std::string("/sys/devices/virtual/input/") + device + "/event*";
  glob_t found{};
  const bool is_there = glob(pattern.c_str(), 0, nullptr, &found) == 0;
  if (is_there) path_ = std::string("/dev/input/") + (std::strrchr(found.gl_pathv[0], '/') + 1);
  globfree(&found);
  return is_there;
}

bool UinputDevice::describe() {
  uinput_setup setup{};
  setup.id.bustype = BUS_VIRTUAL;
  setup.id.vendor = description_.vendor;
  setup.id.product = description_.product;
  std::snprintf(setup.name, sizeof(setup.name), "%s", description_.name.c_str());
  bool good = ioctl(descriptor_, UI_DEV_SETUP, &setup) == 0;
  if (!description_.phys.empty())
    good = good && ioctl(descriptor_, UI_SET_PHYS, description_.phys.c_str()) == 0;
  if (!description_.keys.empty()) good = good && ioctl(descriptor_, UI_SET_EVBIT, EV_KEY) == 0;
  for (const int code : description_.keys) good = good && ioctl(descriptor_, UI_SET_KEYBIT, code) == 0;
  if (!description_.relative_axes.empty()) good = good && ioctl(descriptor_, UI_SET_EVBIT, EV_REL) == 0;
  for (const int code : description_.relative_axes)
    good = good && ioctl(descriptor_, UI_SET_RELBIT, code) == 0;
  if (!description_.axes.empty()) good = good && ioctl(descriptor_, UI_SET_EVBIT, EV_ABS) == 0;
  for (const UinputDescription::Axis& axis : description_.axes) {
    uinput_abs_setup range{};
    range.code = static_cast<std::uint16_t>(axis.code);
    range.absinfo.minimum = axis.minimum;
    range.absinfo.maximum = axis.maximum;
    good = good && ioctl(descriptor_, UI_ABS_SETUP, &range) == 0;
  }
  return good;
}

void UinputDevice::report(int type, int code, int value) {
  input_event events[2] = {};
  events[0].type = static_cast<std::uint16_t>(type);
  events[0].code = static_cast<std::uint16_t>(code);
  events[0].value = value;
  events[1].type = EV_SYN;
  events[1].code = SYN_REPORT;
  if (write(descriptor_, events, sizeof(events)) != sizeof(events)) std::perror("uinput");
}

bool UinputDevice::grab() {
  grabbed_ = open(path_.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  return grabbed_ >= 0 && ioctl(grabbed_, EVIOCGRAB, 1) == 0;
}

}  // namespace flexrf
