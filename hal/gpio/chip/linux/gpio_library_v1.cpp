#include <fcntl.h>
#include <gpiod.h>

#include <cerrno>
#include <cstring>

#include "hal/gpio/chip/linux/gpio_library.hpp"
#include "hal/gpio/chip/linux/gpio_messages.hpp"
#include "hal/gpio/chip/linux/line_offset.hpp"

namespace flexrf {
namespace {

struct CloseChip {
  void operator()(gpiod_chip* chip) const noexcept { gpiod_chip_close(chip); }
};
using Chip = std::unique_ptr<gpiod_chip, CloseChip>;

constexpr const char* consumer = "flexrf";

Chip open_chip(const char* name) {
  constexpr const char* prefix = "gpiochip";
  if (name[0] == '/') return Chip{gpiod_chip_open(name)};
  if (std::strncmp(name, prefix, std::strlen(prefix)) == 0) return Chip{gpiod_chip_open_by_name(name)};
  return Chip{gpiod_chip_open_by_label(name)};
}

int flags_of(const GpioLineSettings& settings) {
  int flags = settings.active_low ? GPIOD_LINE_REQUEST_FLAG_ACTIVE_LOW : 0;
  switch (settings.bias) {
    case LineBias::as_is:
      break;
    case LineBias::disabled:
      flags |= GPIOD_LINE_REQUEST_FLAG_BIAS_DISABLE;
      break;
    case LineBias::pull_up:
      flags |= GPIOD_LINE_REQUEST_FLAG_BIAS_PULL_UP;
      break;
    case LineBias::pull_down:
      flags |= GPIOD_LINE_REQUEST_FLAG_BIAS_PULL_DOWN;
      break;
  }
  return flags;
}

class LineV1 final : public LibraryLine {
 public:
  /// The line is the chip's, and released when it is closed.
  LineV1(Chip chip, gpiod_line* line, int descriptor) noexcept
      : chip_(std::move(chip)), line_(line), descriptor_(descriptor) {}

  int value() noexcept override {
    const int value = gpiod_line_get_value(line_);
    return value < 0 ? -errno : value;
  }
  int set(bool on) noexcept override { return gpiod_line_set_value(line_, on ? 1 : 0) < 0 ? -errno : 0; }
  int next_edge(GpioEdge& edge) noexcept override {
    if (descriptor_ < 0) return 0;
    gpiod_line_event event{};
    if (gpiod_line_event_read_fd(descriptor_, &event) < 0) return errno == EAGAIN ? 0 : -errno;
    edge.on = event.event_type == GPIOD_LINE_EVENT_RISING_EDGE;
    // CLOCK_MONOTONIC since Linux 5.7.
    edge.at = Time{Duration{static_cast<std::int64_t>(event.ts.tv_sec) * 1'000'000'000 + event.ts.tv_nsec}};
    return 1;
  }
  int descriptor() const noexcept override { return descriptor_; }

 private:
  Chip chip_;
  gpiod_line* line_;
  int descriptor_;
};

}  // namespace

Status LibraryLine::probe(const char* chip) {
  errno = ENOENT;
  return open_chip(chip) != nullptr ? Status{} : cannot_open_chip(chip, errno);
}

Result<std::unique_ptr<LibraryLine>> LibraryLine::request(const char* name,
                                                          const GpioLineSettings& settings) {
  errno = ENOENT;
  Chip chip = open_chip(name);
  if (chip == nullptr) return cannot_open_chip(name, errno);
  const Result<unsigned> offset =
      offset_of_line(name, settings.name, gpiod_chip_num_lines(chip.get()), [&chip](unsigned at) {
        gpiod_line* const one = gpiod_chip_get_line(chip.get(), at);
        const char* const known = one == nullptr ? nullptr : gpiod_line_name(one);
        return std::string(known == nullptr ? "" : known);
      });
  if (!offset) return offset.status();
  gpiod_line* const line = gpiod_chip_get_line(chip.get(), *offset);
  if (line == nullptr) return cannot_request_line(name, settings.name, nullptr, errno);
  const bool output = settings.direction == LineDirection::output;
  const gpiod_line_request_config config{
      consumer, output ? GPIOD_LINE_REQUEST_DIRECTION_OUTPUT : GPIOD_LINE_REQUEST_EVENT_BOTH_EDGES,
      flags_of(settings)};
  if (gpiod_line_request(line, &config, settings.initially_on ? 1 : 0) < 0)
    return cannot_request_line(name, settings.name, gpiod_line_consumer(line), errno);
  int descriptor = -1;
  if (!output) {
    descriptor = gpiod_line_event_get_fd(line);
    // No edge must not hold up the cycle.
    if (fcntl(descriptor, F_SETFL, fcntl(descriptor, F_GETFL) | O_NONBLOCK) < 0)
      return cannot_request_line(name, settings.name, gpiod_line_consumer(line), errno);
  }
  return std::unique_ptr<LibraryLine>(std::make_unique<LineV1>(std::move(chip), line, descriptor));
}

}  // namespace flexrf
