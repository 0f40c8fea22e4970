// FirstLook: how long the first job of a picture waits until a recogniser begins.
#pragma once

#include <vector>

#include "benchmarks/visual_servoing/wall_cell.hpp"

namespace flexrf::bench {

/// From the traces of steps: the first job of a picture is there when the first member of attention, or the
/// tracks, have ended their step; a recogniser looks when its next step begins.
class FirstLook {
 public:
  explicit FirstLook(WallCell& cell);
  /// Ten times a second and more often.
  void collect();
  /// In us, one for each picture. Empties what was collected.
  std::vector<double> waits();

 private:
  void collect(std::size_t thread, bool posts);

  WallCell& cell_;
  Time since_;
  std::vector<Time> posted_;
  std::vector<Time> looked_;
};

}  // namespace flexrf::bench
