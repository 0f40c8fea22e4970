#include "hal/modbus/link/simulator/serial_simulator.hpp"

namespace flexrf {

bool SerialSimulator::use_line(CommandLine& line, const char* device) {
  device_ = device;
  is_pseudo_terminal_ = line.has("--pseudo-terminal");
  return is_pseudo_terminal_ != (device != nullptr);
}

Status SerialSimulator::begin() {
  if (is_pseudo_terminal()) {
    if (const Status status = pseudo_.open(); !status) return status;
  }
  return plug();
}

std::string SerialSimulator::place() const {
  return is_pseudo_terminal() ? pseudo_.path() : device_;
}

std::string SerialSimulator::answer(const std::string& line) {
  if (is_pseudo_terminal() && line == "unplug") {
    unplug();
    pseudo_.close();
    return "ok";
  }
  if (is_pseudo_terminal() && line == "plug") {
    const Status status = begin();
    return status ? place() : status.cause();
  }
  return obey(line);
}

}  // namespace flexrf
