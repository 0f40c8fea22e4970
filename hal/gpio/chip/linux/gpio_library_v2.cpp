#include <fcntl.h>
#include <glob.h>
#include <gpiod.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <utility>

#include "hal/gpio/chip/linux/gpio_library.hpp"
#include "hal/gpio/chip/linux/gpio_messages.hpp"
#include "hal/gpio/chip/linux/line_offset.hpp"

namespace flexrf {
namespace {

template <auto Free>
struct FreeBy {
  template <class Object>
  void operator()(Object* object) const noexcept {
    Free(object);
  }
};
template <class Object, auto Free>
using Owned = std::unique_ptr<Object, FreeBy<Free>>;

using Chip = Owned<gpiod_chip, gpiod_chip_close>;
using ChipInfo = Owned<gpiod_chip_info, gpiod_chip_info_free>;
using LineInfo = Owned<gpiod_line_info, gpiod_line_info_free>;
using LineConfig = Owned<gpiod_line_config, gpiod_line_config_free>;
using LineSettings = Owned<gpiod_line_settings, gpiod_line_settings_free>;
using RequestConfig = Owned<gpiod_request_config, gpiod_request_config_free>;
using LineRequest = Owned<gpiod_line_request, gpiod_line_request_release>;
using EdgeEvents = Owned<gpiod_edge_event_buffer, gpiod_edge_event_buffer_free>;

constexpr const char* consumer = "flexrf";

bool has_label(gpiod_chip* chip, const char* label) {
  const ChipInfo info{gpiod_chip_get_info(chip)};
  return info != nullptr && std::strcmp(gpiod_chip_info_get_label(info.get()), label) == 0;
}

/// This version opens paths only. What kept a chip from being looked at is the cause when none has the label.
Chip open_by_label(const char* label) {
  glob_t found{};
  int cause = ENOENT;
  Chip chip;
  if (glob("/dev/gpiochip*", 0, nullptr, &found) == 0) {
    for (std::size_t i = 0; i < found.gl_pathc && chip == nullptr; ++i) {
      chip.reset(gpiod_chip_open(found.gl_pathv[i]));
      if (chip == nullptr) {
        cause = errno;
      } else if (!has_label(chip.get(), label)) {
        chip.reset();
      }
    }
  }
  globfree(&found);
  errno = cause;
  return chip;
}

Chip open_chip(const char* name) {
  constexpr const char* prefix = "gpiochip";
  if (name[0] == '/') return Chip{gpiod_chip_open(name)};
  if (std::strncmp(name, prefix, std::strlen(prefix)) != 0) return open_by_label(name);
  char path[64];
  std::snprintf(path, sizeof(path), "/dev/%s", name);
  return Chip{gpiod_chip_open(path)};
}

gpiod_line_bias bias_of(LineBias bias) {
  switch (bias) {
    case LineBias::as_is:
      break;
    case LineBias::disabled:
      return GPIOD_LINE_BIAS_DISABLED;
    case LineBias::pull_up:
      return GPIOD_LINE_BIAS_PULL_UP;
    case LineBias::pull_down:
      return GPIOD_LINE_BIAS_PULL_DOWN;
  }
  return GPIOD_LINE_BIAS_AS_IS;
}

/// 0, else −1 and errno.
int describe(gpiod_line_settings* line, const GpioLineSettings& settings) {
  gpiod_line_settings_set_active_low(line, settings.active_low);
  if (gpiod_line_settings_set_bias(line, bias_of(settings.bias)) < 0) return -1;
  if (settings.direction == LineDirection::output) {
    const gpiod_line_value value =
        settings.initially_on ? GPIOD_LINE_VALUE_ACTIVE : GPIOD_LINE_VALUE_INACTIVE;
    return gpiod_line_settings_set_direction(line, GPIOD_LINE_DIRECTION_OUTPUT) < 0
               ? -1
               : gpiod_line_settings_set_output_value(line, value);
  }
  return gpiod_line_settings_set_direction(line, GPIOD_LINE_DIRECTION_INPUT) < 0 ||
                 gpiod_line_settings_set_event_clock(line, GPIOD_LINE_CLOCK_MONOTONIC) < 0
             ? -1
             : gpiod_line_settings_set_edge_detection(line, GPIOD_LINE_EDGE_BOTH);
}

/// Null, and errno.
LineRequest request_line(gpiod_chip* chip, unsigned offset, const GpioLineSettings& settings) {
  const LineSettings line{gpiod_line_settings_new()};
  const LineConfig lines{gpiod_line_config_new()};
  const RequestConfig request{gpiod_request_config_new()};
  if (line == nullptr || lines == nullptr || request == nullptr || describe(line.get(), settings) < 0 ||
      gpiod_line_config_add_line_settings(lines.get(), &offset, 1, line.get()) < 0)
    return nullptr;
  gpiod_request_config_set_consumer(request.get(), consumer);
  return LineRequest{gpiod_chip_request_lines(chip, request.get(), lines.get())};
}

class LineV2 final : public LibraryLine {
 public:
  /// `events`: room for one; null: an output.
  LineV2(LineRequest request, unsigned offset, EdgeEvents events) noexcept
      : request_(std::move(request)), events_(std::move(events)), offset_(offset) {}

  int value() noexcept override {
    const gpiod_line_value value = gpiod_line_request_get_value(request_.get(), offset_);
    return value == GPIOD_LINE_VALUE_ERROR ? -errno : value == GPIOD_LINE_VALUE_ACTIVE ? 1 : 0;
  }
  int set(bool on) noexcept override {
    const gpiod_line_value value = on ? GPIOD_LINE_VALUE_ACTIVE : GPIOD_LINE_VALUE_INACTIVE;
    return gpiod_line_request_set_value(request_.get(), offset_, value) < 0 ? -errno : 0;
  }
  int next_edge(GpioEdge& edge) noexcept override {
    if (events_ == nullptr) return 0;
    if (gpiod_line_request_read_edge_events(request_.get(), events_.get(), 1) < 0)
      return errno == EAGAIN ? 0 : -errno;
    gpiod_edge_event* const event = gpiod_edge_event_buffer_get_event(events_.get(), 0);
    edge.on = gpiod_edge_event_get_event_type(event) == GPIOD_EDGE_EVENT_RISING_EDGE;
    edge.at = Time{Duration{static_cast<std::int64_t>(gpiod_edge_event_get_timestamp_ns(event))}};
    return 1;
  }
  int descriptor() const noexcept override {
    return events_ == nullptr ? -1 : gpiod_line_request_get_fd(request_.get());
  }

 private:
  LineRequest request_;
  EdgeEvents events_;
  unsigned offset_;
};

}  // namespace

Status LibraryLine::probe(const char* chip) {
  return open_chip(chip) != nullptr ? Status{} : cannot_open_chip(chip, errno);
}

Result<std::unique_ptr<LibraryLine>> LibraryLine::request(const char* name,
                                                          const GpioLineSettings& settings) {
  const Chip chip = open_chip(name);
  if (chip == nullptr) return cannot_open_chip(name, errno);
  const ChipInfo chip_info{gpiod_chip_get_info(chip.get())};
  if (chip_info == nullptr) return cannot_open_chip(name, errno);
  const auto count = static_cast<unsigned>(gpiod_chip_info_get_num_lines(chip_info.get()));
  const Result<unsigned> found = offset_of_line(name, settings.name, count, [&chip](unsigned at) {
    const LineInfo info{gpiod_chip_get_line_info(chip.get(), at)};
    const char* const known = info == nullptr ? nullptr : gpiod_line_info_get_name(info.get());
    return std::string(known == nullptr ? "" : known);
  });
  if (!found) return found.status();
  const unsigned offset = *found;
  const auto cannot_request = [&](int error) {
    const LineInfo info{gpiod_chip_get_line_info(chip.get(), offset)};
    return cannot_request_line(name, settings.name,
                               info == nullptr ? nullptr : gpiod_line_info_get_consumer(info.get()), error);
  };
  // The request is of its own: the chip may be closed.
  LineRequest request = request_line(chip.get(), offset, settings);
  if (request == nullptr) return cannot_request(errno);
  EdgeEvents events;
  if (settings.direction == LineDirection::input) {
    events.reset(gpiod_edge_event_buffer_new(1));
    if (events == nullptr) return cannot_request(errno);
    // No edge must not hold up the cycle.
    const int descriptor = gpiod_line_request_get_fd(request.get());
    if (fcntl(descriptor, F_SETFL, fcntl(descriptor, F_GETFL) | O_NONBLOCK) < 0) return cannot_request(errno);
  }
  return std::unique_ptr<LibraryLine>(
      std::make_unique<LineV2>(std::move(request), offset, std::move(events)));
}

}  // namespace flexrf
