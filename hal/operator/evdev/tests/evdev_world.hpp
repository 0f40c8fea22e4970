#pragma once

#include <poll.h>
#include <unistd.h>

#include <cstdio>
#include <optional>

#include "base/text.hpp"
#include "hal/driver/device_bench.hpp"
#include "hal/operator/evdev/tests/uinput_device.hpp"

namespace flexrf {

/// A driver in the guest, and the device that it is to find: what the worlds of the three have in common.
template <class Driver>
class EvdevBench {
 public:
  explicit EvdevBench(const UinputDescription& description)
      : hand(description), device(description.name), bench_(std::in_place, nullptr) {}
  EvdevBench(const EvdevBench&) = delete;
  EvdevBench& operator=(const EvdevBench&) = delete;
  ~EvdevBench() {
    if (forbidden_ && seteuid(0) != 0) std::perror("seteuid");
    driver().stop();
  }

  Status start(std::span<QueueSink* const> sinks = {}) {
    if (!sinks.empty()) bench_.emplace(nullptr, sinks);
    bench_->environment().virtual_time = false;
    set_text(bench_->configuration().device, device);
    bench_->configuration().grab = grab;
    if (forbidden_ && seteuid(nobody) != 0) return Status::error(StatusCode::internal, "seteuid");
    return driver().initialise();
  }
  Driver& driver() { return bench_->driver(); }
  DeviceBench<Driver>& bench() { return *bench_; }
  /// A cycle, as soon as there is something to do, or after 10 ms.
  void receive() {
    pollfd wanted{driver().descriptor(), POLLIN, 0};
    poll(&wanted, 1, 10);
    cycle();
  }
  void cycle() { bench_->receive(std::chrono::milliseconds(1)); }

  bool hide() {
    hand.unplug();
    return true;
  }
  bool forbid() {
    forbidden_ = true;
    return true;
  }
  bool occupy() {
    grab = true;
    return hand.grab();
  }

  UinputDevice hand;
  std::string device;  ///< as the driver is configured
  bool grab = false;

 private:
  static constexpr uid_t nobody = 65534;

  std::optional<DeviceBench<Driver>> bench_;
  bool forbidden_ = false;
};

}  // namespace flexrf
