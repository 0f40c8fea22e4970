// SerialSimulator: a program that simulates a station on a serial line, which may be a pseudo-terminal.
#pragma once

#include "hal/driver/simulator/simulator_program.hpp"
#include "hal/modbus/link/simulator/pseudo_serial_line.hpp"

namespace flexrf {

/// Of a pseudo-terminal it knows the lines "unplug" and "plug" by itself: its adapter is pulled out, and
/// plugged in again with the line's new name.
class SerialSimulator : public SimulatorProgram {
 public:
  Status begin() final;
  std::string place() const override;
  std::string answer(const std::string& line) final;

 protected:
  /// On a pseudo-terminal where the command line says so, else at this device. False: both, or neither.
  bool use_line(CommandLine& line, const char* device);
  const char* device() const noexcept { return device_; }
  bool is_pseudo_terminal() const noexcept { return is_pseudo_terminal_; }
  /// Of the pseudo-terminal.
  int descriptor() const noexcept { return pseudo_.descriptor(); }

  /// Begins to be a station on the line.
  virtual Status plug() = 0;
  virtual void unplug() = 0;
  /// As answer().
  virtual std::string obey(const std::string& line) = 0;

 private:
  const char* device_ = nullptr;
  bool is_pseudo_terminal_ = false;
  PseudoSerialLine pseudo_;
};

}  // namespace flexrf
