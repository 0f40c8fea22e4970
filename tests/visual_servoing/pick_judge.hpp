// PickJudge: what became of each approach, by the truth of the scene.
//
// A pick is good when, as the fingers begin to close, the part is where the picker takes it to be (3 mm, and
// 5 degrees within its symmetry), and it comes into its bin.
#pragma once

#include <string>
#include <vector>

#include "tests/visual_servoing/servoing_cell.hpp"

namespace flexrf::visual_servoing {

struct Approach {
  double began = 0;  // s since the start
  double ended = 0;
  std::uint16_t kind = 0;
  bool closed = false;     // the fingers were closed
  double place_error = 0;  // m, when they began to
  double angle_error = 0;  // rad, within the part's symmetry; 0 of a disc
  bool binned = false;
  std::string cause;  // why it was not
  bool is_good() const { return binned && place_error <= 0.003 && angle_error <= 0.0873; }
};

class PickJudge {
 public:
  explicit PickJudge(ServoingCell& cell) : cell_(cell) {}
  /// Once in each cycle.
  void look();
  /// Those that ended.
  const std::vector<Approach>& approaches() const { return approaches_; }
  std::size_t good() const;
  bool verbose = false;

 private:
  void measure();
  void tell_obstacles() const;
  void end(const std::string& cause, bool binned);

  ServoingCell& cell_;
  std::vector<Approach> approaches_;
  Approach now_;
  bool is_under_way_ = false;
  std::uint64_t begun_ = 0;
  std::uint64_t binned_ = 0;
  PickerState state_ = PickerState::off;
};

}  // namespace flexrf::visual_servoing
