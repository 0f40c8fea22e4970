// What every driver of ServoDrive must do. A driver's test makes a world, which is the driver and its far
// end, and runs the cases in it.
#pragma once

#include <memory>

#include "hal/servo_drive/interface/servo_drive.hpp"

namespace flexrf {

class ServoDriveWorld {
 public:
  virtual ~ServoDriveWorld() = default;

  /// Initialised, at rest at 1, its home at 0, permitted to move; range from -10 to 10, at most 20 a second,
  /// 2 while it homes, accelerated by 100.
  virtual ServoDrive& drive() = 0;
  /// The thread's cycle: receive, then what the unit does, then send; `elapsed` after the last one.
  virtual void receive(Duration elapsed) = 0;
  virtual void send() = 0;

  /// Whether the drive's cycles are this thread's. Those of another process are now shorter and now longer,
  /// and how far the axis went in one is not judged.
  virtual bool shares_its_cycle() const { return true; }
  /// The far end is no longer heard. False: cannot be made to happen with this driver.
  virtual bool lose_drive() { return false; }
  /// What lose_drive() did is undone. False: cannot be made to happen with this driver.
  virtual bool find_drive() { return false; }
  /// Somebody moves the axis so far, who cannot while it resists. False: cannot be made to happen with this
  /// driver.
  virtual bool move_by_hand(double /*way*/) { return false; }
  /// The axis stays where it is, whatever is commanded. False: cannot be made to happen with this driver.
  virtual bool stick_axis() { return false; }
  /// The drive trips. False: cannot be made to happen with this driver.
  virtual bool trip_drive() { return false; }
  /// The drive no longer finds its home. False: cannot be made to happen with this driver.
  virtual bool lose_home() { return false; }
};

/// As the configuration says.
struct ServoDriveSetup {
  ServoMode mode = ServoMode::cyclic_position;
  bool needs_home = false;  ///< by a method that has its home at 0
  bool endless = false;     ///< then it has no range
  double modulo = 0;
};
using MakeServoDriveWorld = std::unique_ptr<ServoDriveWorld> (*)(const ServoDriveSetup& setup);

/// Runs all cases, each in a world of its own; returns the number that failed, for main().
int run_servo_drive_conformance(const char* driver, MakeServoDriveWorld make);

}  // namespace flexrf
