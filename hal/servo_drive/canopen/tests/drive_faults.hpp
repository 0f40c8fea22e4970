// What goes wrong between a CANopen drive and its driver: cases that are run on a simulated bus in virtual
// time, and on a real one against a simulator in another process.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "hal/servo_drive/canopen/canopen_servo_drive.hpp"

namespace flexrf {

enum class BusLoss {
  cable,    ///< between both, or what comes next to it
  adapter,  ///< the interface of this end is gone
  bus_off,  ///< this end went off the bus, by the errors that it counted
};

/// A driver that goes slowly from 1 towards 9 when it is told, its bus, and the drive at the far end, which
/// is told by lines what shall go wrong (drive_console.hpp).
class DriveFaultWorld {
 public:
  static constexpr Duration cycle = std::chrono::milliseconds(7);
  static constexpr std::uint8_t node = 5;

  virtual ~DriveFaultWorld() = default;

  virtual CanopenServoDrive& drive() = 0;
  /// A cycle of the thread that the driver lives in; `position`: what its unit commands.
  virtual void step(double position) = 0;
  /// Time passes, and this end neither receives nor sends.
  virtual void stall(Duration time) = 0;
  /// As an operator's reset does it: the driver is initialised anew.
  virtual void restart() = 0;

  /// The far end's answer.
  virtual std::string ask(std::string_view line) = 0;
  bool tell(std::string_view line) { return ask(line) == "ok"; }
  /// Until it is restored.
  virtual bool lose_bus(BusLoss how) = 0;
  virtual bool restore_bus(BusLoss how) = 0;
  virtual CanBusState bus_state() = 0;

  /// The clock of step().
  virtual Time now() const = 0;

 protected:
  static void configure(CanopenServoDrive::Configuration& configuration);
};

using MakeDriveFaultWorld = std::unique_ptr<DriveFaultWorld> (*)();

/// Runs all cases, each in a world of its own; returns the number that failed, for main().
int run_drive_faults(const char* where, MakeDriveFaultWorld make);

}  // namespace flexrf
