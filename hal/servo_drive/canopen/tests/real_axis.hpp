// For tests in the guest: the driver on a vcan interface of its own, as root.
#pragma once

#include <net/if.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <string>
#include <thread>

#include "hal/can/socket_can/socket_can_bus.hpp"
#include "hal/driver/device_bench.hpp"
#include "hal/servo_drive/canopen/canopen_servo_drive.hpp"
#include "tests/simulator_process.hpp"

namespace flexrf {

inline constexpr const char* can_interface = "vcanservo";
inline constexpr Duration real_cycle = std::chrono::milliseconds(7);

inline bool ip(const std::string& words) {
  return std::system(("ip " + words).c_str()) == 0;
}
inline bool add_interface() {
  return ip(std::string("link add ") + can_interface + " type vcan");
}
inline bool remove_interface() {
  return ip(std::string("link del ") + can_interface);
}
inline bool set_interface(bool up) {
  return ip(std::string("link set ") + can_interface + (up ? " up" : " down"));
}

/// One of its own, which goes with it.
class VirtualInterface {
 public:
  explicit VirtualInterface(bool there) {
    if (if_nametoindex(can_interface) != 0) remove_interface();
    if (there) ready_ = add_interface() && set_interface(true);
  }
  ~VirtualInterface() {
    if (if_nametoindex(can_interface) != 0) remove_interface();
  }
  bool is_ready() const { return ready_; }

 private:
  bool ready_ = false;
};

/// Cycles are paced by the clock of the machine.
template <class Driver>
class RealDevice {
 public:
  RealDevice() { bus_->configuration().set_interface(can_interface); }
  ~RealDevice() {
    drive().stop();
    bus_->driver().stop();
  }

  auto& configuration() { return drive_->configuration(); }
  Driver& drive() { return drive_->driver(); }
  SocketCanBus& bus() { return bus_->driver(); }
  bool initialise() { return bus_->driver().initialise().is_ok() && drive_->driver().initialise().is_ok(); }
  void receive() {
    next_ = std::max(next_ + real_cycle, MonotonicClock::now() - real_cycle);
    std::this_thread::sleep_for(next_ - MonotonicClock::now());
    bus_->receive(real_cycle);
    drive_->receive(real_cycle);
  }
  void send() {
    drive_->send();
    bus_->send();
  }
  Time now() const { return drive_->now(); }

 private:
  std::unique_ptr<DeviceBench<SocketCanBus>> bus_ = std::make_unique<DeviceBench<SocketCanBus>>(nullptr);
  std::unique_ptr<DeviceBench<Driver>> drive_ =
      std::make_unique<DeviceBench<Driver>>(nullptr, std::span<QueueSink* const>{}, &bus_->driver());
  Time next_ = MonotonicClock::now();
};

using RealAxis = RealDevice<CanopenServoDrive>;

}  // namespace flexrf
