// Whether the application is as it should be, in one word: for whoever supervises the machine.
#pragma once

#include <string>

#include "runtime/executive/cell.hpp"

namespace flexrf::panel {

/// Empty: it runs, which it does not with a thread that hangs, and no device and no unit is in fault: what
/// had to answer has answered. Else why not, for a log. No time that was missed counts: a busy machine is not
/// a fault. Any thread that is not real-time.
std::string why_not_healthy(const Cell& cell);

}  // namespace flexrf::panel
