// GPIO, camera, watchdog and input devices of the guest.
#include <fcntl.h>
#include <glob.h>
#include <linux/gpio.h>
#include <linux/input.h>
#include <linux/uinput.h>
#include <linux/videodev2.h>
#include <linux/watchdog.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <cstring>
#include <initializer_list>
#include <iterator>

#include "tests/cmocka.hpp"
#include "tests/guest/prepared_devices.hpp"
#include "tests/guest/waiting.hpp"

namespace flexrf {

namespace {

constexpr const char* chip_label = "flexrf-sim";
constexpr const char* line_names[] = {"ESTOP",       "REED_OPEN", "REED_CLOSED", "VALVE_OPEN",
                                      "VALVE_CLOSE", "LAMP",      "BUTTON",      "SPARE"};
constexpr unsigned button = 6;
constexpr unsigned spare = 7;

/// The chip with the label of the guest's: it bears another number once it was unplugged while a line was
/// held.
int open_chip(gpiochip_info& description) {
  glob_t found{};
  if (::glob("/dev/gpiochip*", 0, nullptr, &found) != 0) fail_msg("there is no %s", "/dev/gpiochip*");
  for (std::size_t index = 0; index < found.gl_pathc; ++index) {
    const int chip = open_device(found.gl_pathv[index]);
    assert_int_equal(::ioctl(chip, GPIO_GET_CHIPINFO_IOCTL, &description), 0);
    if (std::strcmp(description.label, chip_label) == 0) {
      ::globfree(&found);
      return chip;
    }
    ::close(chip);
  }
  fail_msg("there is no chip %s", chip_label);
  return -1;
}

int request_line(unsigned line, std::uint64_t flags) {
  gpiochip_info description{};
  const int chip = open_chip(description);
  gpio_v2_line_request request{};
  request.offsets[0] = line;
  request.num_lines = 1;
  request.config.flags = flags;
  std::strcpy(request.consumer, "guest_devices_test");
  const int result = ::ioctl(chip, GPIO_V2_GET_LINE_IOCTL, &request);
  ::close(chip);
  if (result != 0) fail_msg("line %u was refused", line);
  return request.fd;
}

bool level(int request) {
  gpio_v2_line_values values{.bits = 0, .mask = 1};
  assert_int_equal(::ioctl(request, GPIO_V2_LINE_GET_VALUES_IOCTL, &values), 0);
  return values.bits != 0;
}

void set_level(int request, bool high) {
  gpio_v2_line_values values{.bits = high ? 1U : 0U, .mask = 1};
  assert_int_equal(::ioctl(request, GPIO_V2_LINE_SET_VALUES_IOCTL, &values), 0);
}

/// The file by which the simulated line is driven or seen from outside; the first that fits the pattern.
int outside_of(unsigned line, const char* what) {
  char pattern[96];
  std::snprintf(pattern, sizeof pattern, "/sys/devices/platform/gpio-sim.*/gpiochip*/sim_gpio%u/%s", line,
                what);
  glob_t found{};
  if (::glob(pattern, 0, nullptr, &found) != 0) fail_msg("there is no %s", pattern);
  const int descriptor = open_device(found.gl_pathv[0]);
  ::globfree(&found);
  return descriptor;
}

void pull(unsigned line, const char* where) {
  const int descriptor = outside_of(line, "pull");
  assert_int_equal(::write(descriptor, where, std::strlen(where)), std::strlen(where));
  ::close(descriptor);
}

char seen_outside(unsigned line) {
  const int descriptor = outside_of(line, "value");
  char value = 0;
  assert_int_equal(::read(descriptor, &value, 1), 1);
  ::close(descriptor);
  return value;
}

void expect_edge(int request, std::uint32_t edge) {
  gpio_v2_line_event event{};
  read_exactly(request, &event, sizeof event);
  assert_int_equal(event.id, edge);
}

/// A keyboard of one key that the kernel believes in; its file.
int make_keyboard() {
  const int keyboard = open_device("/dev/uinput");
  uinput_setup setup{};
  setup.id.bustype = BUS_VIRTUAL;
  std::strcpy(setup.name, "guest_devices_test");
  assert_int_equal(::ioctl(keyboard, UI_SET_EVBIT, EV_KEY), 0);
  assert_int_equal(::ioctl(keyboard, UI_SET_KEYBIT, KEY_W), 0);
  assert_int_equal(::ioctl(keyboard, UI_DEV_SETUP, &setup), 0);
  assert_int_equal(::ioctl(keyboard, UI_DEV_CREATE), 0);
  return keyboard;
}

/// The event device that belongs to it.
int events_of(int keyboard) {
  char name[32] = {};
  assert_true(::ioctl(keyboard, UI_GET_SYSNAME(sizeof name), name) > 0);
  char pattern[96];
  std::snprintf(pattern, sizeof pattern, "/sys/devices/virtual/input/%s/event*", name);
  glob_t found{};
  if (::glob(pattern, 0, nullptr, &found) != 0) fail_msg("there is no %s", pattern);
  char path[64];
  std::snprintf(path, sizeof path, "/dev/input/%s", std::strrchr(found.gl_pathv[0], '/') + 1);
  ::globfree(&found);
  return open_device(path);
}

void press(int keyboard, int value) {
  input_event events[2] = {};
  events[0].type = EV_KEY;
  events[0].code = KEY_W;
  events[0].value = value;
  events[1].type = EV_SYN;
  assert_int_equal(::write(keyboard, events, sizeof events), sizeof events);
}

}  // namespace

void gpio_lines_bear_their_names(void**) {
  gpiochip_info description{};
  const int chip = open_chip(description);
  assert_int_equal(description.lines, std::size(line_names));
  for (unsigned line = 0; line < std::size(line_names); ++line) {
    gpio_v2_line_info information{};
    information.offset = line;
    assert_int_equal(::ioctl(chip, GPIO_V2_GET_LINEINFO_IOCTL, &information), 0);
    assert_string_equal(information.name, line_names[line]);
  }
  ::close(chip);
}

void an_input_that_is_pulled_up_is_an_edge_and_a_level(void**) {
  pull(button, "pull-down");
  const int request = request_line(
      button, GPIO_V2_LINE_FLAG_INPUT | GPIO_V2_LINE_FLAG_EDGE_RISING | GPIO_V2_LINE_FLAG_EDGE_FALLING);
  assert_false(level(request));
  pull(button, "pull-up");
  expect_edge(request, GPIO_V2_LINE_EVENT_RISING_EDGE);
  assert_true(level(request));
  pull(button, "pull-down");
  expect_edge(request, GPIO_V2_LINE_EVENT_FALLING_EDGE);
  assert_false(level(request));
  ::close(request);
}

void an_output_is_seen_from_outside(void**) {
  const int request = request_line(spare, GPIO_V2_LINE_FLAG_OUTPUT);
  assert_int_equal(seen_outside(spare), '0');
  set_level(request, true);
  assert_int_equal(seen_outside(spare), '1');
  ::close(request);
}

void the_camera_captures_and_streams(void**) {
  const int camera = open_device("/dev/video0");
  v4l2_capability capability{};
  assert_int_equal(::ioctl(camera, VIDIOC_QUERYCAP, &capability), 0);
  assert_string_equal(reinterpret_cast<const char*>(capability.driver), "vivid");
  assert_true((capability.device_caps & V4L2_CAP_VIDEO_CAPTURE) != 0);
  assert_true((capability.device_caps & V4L2_CAP_STREAMING) != 0);
  ::close(camera);
}

void the_watchdog_is_fed_and_let_go(void**) {
  const int watchdog = open_device("/dev/watchdog");
  watchdog_info information{};
  assert_int_equal(::ioctl(watchdog, WDIOC_GETSUPPORT, &information), 0);
  assert_non_null(std::strstr(reinterpret_cast<const char*>(information.identity), "i6300ESB"));
  assert_int_equal(::ioctl(watchdog, WDIOC_KEEPALIVE, nullptr), 0);
  assert_int_equal(::write(watchdog, "V", 1), 1);  // or it would end the machine after it is closed
  ::close(watchdog);
}

void a_key_of_a_made_up_keyboard_is_an_event(void**) {
  const int keyboard = make_keyboard();
  const int events = events_of(keyboard);
  for (const int value : {1, 0}) {
    press(keyboard, value);
    input_event event{};
    read_exactly(events, &event, sizeof event);
    assert_int_equal(event.type, EV_KEY);
    assert_int_equal(event.code, KEY_W);
    assert_int_equal(event.value, value);
    read_exactly(events, &event, sizeof event);
    assert_int_equal(event.type, EV_SYN);
  }
  ::close(events);
  ::close(keyboard);
}

}  // namespace flexrf
