// CanInterfaceClaim: which bus of this process has which CAN interface.
#pragma once

#include <string>

#include "base/status.hpp"

namespace flexrf {

/// The kernel lets any number of sockets use one interface. Two buses of a cell on it do not know each
/// other's devices, so that two drives of one node number would both be led. Lifecycle thread.
class CanInterfaceClaim {
 public:
  CanInterfaceClaim() = default;
  CanInterfaceClaim(const CanInterfaceClaim&) = delete;
  CanInterfaceClaim& operator=(const CanInterfaceClaim&) = delete;
  ~CanInterfaceClaim() { release(); }

  /// Error: another bus has it, which is named. `bus`: this one's name.
  Status take(const std::string& interface, const std::string& bus);
  void release();

 private:
  std::string interface_;  // empty: none
};

}  // namespace flexrf
