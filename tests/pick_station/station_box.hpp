// StationBox: the operator's box of the pick station, as a simulated chip of the guest's kernel.
#pragma once

#include "hal/gpio/chip/linux/tests/gpio_sim.hpp"

namespace flexrf::whole {

/// A chip of its own, labelled and with its lines named as the station's table has them. The emergency stop
/// is released. CheckFailed: the kernel refuses.
class StationBox {
 public:
  StationBox();
  ~StationBox();
  StationBox(const StationBox&) = delete;
  StationBox& operator=(const StationBox&) = delete;

  /// Its second contact is closed to supply while it is released.
  void press_emergency_stop(bool pressed) { chip_.pull("ESTOP", !pressed); }
  /// The chip goes, or comes back with the emergency stop pressed.
  void plug(bool in) { in ? chip_.plug_in() : chip_.unplug(); }
  /// By the name of its line; one that blinks is lit or dark.
  bool is_lit(const char* lamp) { return chip_.is_high(lamp); }

 private:
  GpioSim chip_;
};

}  // namespace flexrf::whole
