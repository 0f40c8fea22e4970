// Heartbeat watch: sees to it that every thread gives signs of life, also one that has nothing to do.
#pragma once

#include <cstdint>
#include <vector>

#include "runtime/executive/cell.hpp"
#include "runtime/executive/missed_time.hpp"

namespace flexrf {

/// Each turn of a thread is a sign of life. One that is silent for a quarter of its hang_timeout has its bell
/// rung, which a thread that can run answers by a turn without a step. One that does not answer for the rest
/// of it, as its step does not return or others keep it from running, misses the heartbeat, and meets it
/// again with its next turn. The supervising thread.
class HeartbeatWatch {
 public:
  explicit HeartbeatWatch(Cell& cell) : cell_(&cell), heard_(cell.application().threads.size()) {}

  /// Every few milliseconds. `stuck`: the application is given up, whatever its threads do.
  void observe(Time now, bool stuck) noexcept;

 private:
  struct Heard {
    std::uint64_t turns = 0;
    Time at{};
  };

  const char* find_silent(Time now) noexcept;

  Cell* cell_;
  std::vector<Heard> heard_;  // of each thread
  bool has_looked_ = false;
  MissedTime missed_time_;
};

}  // namespace flexrf
