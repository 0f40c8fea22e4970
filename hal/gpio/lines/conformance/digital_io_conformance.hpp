// What every driver of DigitalIo must do. A driver's test makes a world, which is the line, its chip and the
// far end of the wire, and runs the cases in it.
#pragma once

#include <memory>

#include "hal/gpio/lines/interface/digital_io.hpp"
#include "hal/gpio/lines/interface/digital_line.hpp"

namespace flexrf {

class DigitalIoWorld {
 public:
  virtual ~DigitalIoWorld() = default;

  /// Configures (but for the name, which is the world's) and initialises the line; permitted to move.
  /// `signal`: as an output that is one.
  virtual Status start(const DigitalLineSettings& settings, bool signal) = 0;
  Status start(const DigitalLineSettings& settings) { return start(settings, false); }
  virtual DigitalIo& io() = 0;
  /// The thread's cycle: receive, then what the unit does, then send; `elapsed` or more after the last one.
  virtual void receive(Duration elapsed) = 0;
  virtual void send() = 0;
  /// Of the cycle: virtual, or one that counts.
  virtual Time now() const = 0;

  /// The far end of an input; before start() also. Physical levels: high is some volts.
  virtual void drive(bool high) = 0;
  /// What the far end of an output sees.
  virtual bool sees_high() = 0;
  /// The chip goes, and comes back with nobody driving its lines. False: cannot be made to happen here.
  virtual bool unplug() { return false; }
  virtual bool plug_in() { return false; }
  /// Before start(): somebody else has the line; the right to use the chip is missing. False: as above.
  virtual bool occupy() { return false; }
  virtual bool forbid() { return false; }
  /// Undo that.
  virtual void let_go() {}
  virtual void permit() {}
};

using MakeDigitalIoWorld = std::unique_ptr<DigitalIoWorld> (*)();

/// Runs all cases, each in a world of its own; returns the number that failed, for main().
int run_digital_io_conformance(const char* driver, MakeDigitalIoWorld make);

}  // namespace flexrf
