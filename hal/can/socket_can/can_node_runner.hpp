#pragma once

#include <atomic>

#include "base/status.hpp"
#include "hal/can/interface/can_node.hpp"

namespace flexrf {

/// Runs a simulated device as a node of its own on a CAN interface of this machine, in real time, until
/// `ends` becomes true (looked at every 50 ms) or the interface goes. For simulators that are programs: then
/// the application and the device meet only on the wire. Blocks; not for real-time threads.
Status run_can_node(const char* interface, CanNode& node, const std::atomic<bool>& ends);

}  // namespace flexrf
