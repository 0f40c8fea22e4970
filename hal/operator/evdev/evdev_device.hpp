// EvdevDevice: one input device of the kernel that is open, through libevdev.
#pragma once

#include <linux/input.h>

#include <cstdint>
#include <memory>
#include <string>

#include "base/status.hpp"

struct libevdev;

namespace flexrf {

enum class EvdevKind : std::uint8_t { keyboard, pointer, joystick };

struct EvdevRequest {
  const char* owner = "";  ///< of whom asks, for the log; lives for ever
  /// A path, as of /dev/input/by-id; or its name, its phys, or "vendor:product".
  std::string device;
  bool grab = false;  ///< nobody else gets its events
  EvdevKind kind = EvdevKind::keyboard;
};

class EvdevDevice {
 public:
  /// Finds and opens it; times of its events are CLOCK_MONOTONIC. Allocates, and may wait. not_found,
  /// not_permitted, busy (somebody else has grabbed it), invalid_argument (it is of another kind, or several
  /// are meant), unavailable.
  static Result<std::unique_ptr<EvdevDevice>> open(const EvdevRequest& request);
  EvdevDevice(const EvdevDevice&) = delete;
  EvdevDevice& operator=(const EvdevDevice&) = delete;
  ~EvdevDevice();

  const std::string& path() const noexcept { return path_; }
  int descriptor() const noexcept { return descriptor_; }
  /// Which numbers its axes and buttons have, and what range an axis; does not change while it is open.
  bool has(unsigned type, unsigned code) const noexcept;
  const input_absinfo* axis(unsigned code) const noexcept;

  /// 1: an event; 0: there is none now; else −errno, and it is gone. Never waits, allocates nothing; some
  /// ioctls where the kernel had to drop events: what is down and deflected is then told by events as well.
  /// One thread.
  int next(input_event& event) noexcept;
  /// How often the kernel had to drop events, since it was opened.
  std::uint32_t overflows() const noexcept { return overflows_; }

 private:
  EvdevDevice(std::string path, int descriptor) noexcept : path_(std::move(path)), descriptor_(descriptor) {}
  static Result<std::unique_ptr<EvdevDevice>> open(const std::string& path, const EvdevRequest& request);
  bool is(EvdevKind kind) const noexcept;

  std::string path_;
  int descriptor_;
  libevdev* device_ = nullptr;
  bool catching_up_ = false;
  std::uint32_t overflows_ = 0;
};

}  // namespace flexrf
