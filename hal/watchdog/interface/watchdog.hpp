// Watchdog: a timer that resets the machine unless it is fed.
#pragma once

#include "watchdog_interface.hpp"

namespace flexrf {

/// Belongs to no unit: it has an IO thread of its own, feeds by itself while the application's heartbeat is
/// met [watchdog-1], and says in its feedback how that goes [watchdog-2]. initialise() arms it [watchdog-3],
/// stop() disarms it unless it is to be left armed [watchdog-4]. Whatever ends the application otherwise
/// leaves it armed [watchdog-5].
class Watchdog : public WatchdogInterface {
 public:
  using WatchdogInterface::WatchdogInterface;
};

}  // namespace flexrf
