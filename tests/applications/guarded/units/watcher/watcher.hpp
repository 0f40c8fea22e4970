#pragma once

#include "watcher_unit.hpp"

namespace flexrf::user {

class Watcher final : public WatcherUnit {
 public:
  void step(const Tick& tick) override { lamp->command(tick.motion_inhibited); }
};

}  // namespace flexrf::user
