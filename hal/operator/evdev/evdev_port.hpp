// EvdevPort: an input device that may be unplugged and plugged in again, as the evdev drivers of Keyboard,
// Pointer and Joystick have it.
#pragma once

#include <atomic>
#include <memory>

#include "hal/driver/helper_thread.hpp"
#include "hal/operator/evdev/evdev_device.hpp"

namespace flexrf {

/// Events are read in the cycle, from a descriptor that never waits. A device that goes away is closed, and
/// looked for until it is back, by a thread of its own, the keeper: opening may wait.
class EvdevPort {
 public:
  ~EvdevPort() { end(); }

  // ---- the lifecycle thread, while no cycle runs

  /// The device has to be there now. As EvdevDevice::open().
  Status begin(const EvdevRequest& request);
  void end();

  // ---- the thread of the driver, never waiting, never allocating

  /// Before next(), in each cycle. The device if it is there anew, the first time too; else null.
  const EvdevDevice* begin_cycle() noexcept;
  /// False: there is no more now, or enough for one cycle, or the device went away.
  bool next(input_event& event) noexcept;
  bool is_present() const noexcept { return device_ != nullptr; }
  std::uint32_t losses() const noexcept { return losses_; }
  std::uint32_t overflows() const noexcept;
  /// Readable when there is something to do in a cycle.
  int descriptor() const noexcept;

 private:
  void keep();
  void look_after();
  void lose(int error) noexcept;
  void ring() noexcept;

  EvdevRequest request_;

  // The driver's thread.
  EvdevDevice* device_ = nullptr;
  int events_ = 0;           // in this cycle
  bool unfinished_ = false;  // the cycle before left events behind
  std::uint32_t losses_ = 0;
  std::uint32_t overflows_ = 0;  // of devices before this one

  // Between it and the keeper.
  std::atomic<EvdevDevice*> given_{nullptr};
  std::atomic<bool> returned_{false};
  int news_ = -1;  // an eventfd: a device is given, or events were left behind

  // The keeper's, and the lifecycle thread's while it does not run.
  std::unique_ptr<EvdevDevice> kept_;
  StatusCode trouble_ = StatusCode::ok;
  HelperThread keeper_;
};

}  // namespace flexrf
