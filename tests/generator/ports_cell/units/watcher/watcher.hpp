#pragma once

#include "watcher_unit.hpp"

namespace flexrf::user {

class Watcher final : public WatcherUnit {
 public:
  void step(const Tick& tick) override {
    const View<WayMark> mark = truth.latest();
    feedback.reason = static_cast<std::uint8_t>(mark.reason());
    if (!mark.is_new()) return;
    ++feedback.truths;
    feedback.x = mark->x;
    feedback.delay = (tick.now - mark.sampled_at()).count();
  }
};

}  // namespace flexrf::user
