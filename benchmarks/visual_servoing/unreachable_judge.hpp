// UnreachableJudge: parts that the picker calls unreachable or blocked at its look-out, although the truth of
// the scene has a free grasp of them.
#pragma once

#include <string>
#include <vector>

#include "tests/visual_servoing/servoing_cell.hpp"
#include "units/part_picker/grasp_choice.hpp"

namespace flexrf::bench {

class UnreachableJudge {
 public:
  explicit UnreachableJudge(visual_servoing::ServoingCell& cell) : cell_(cell) {}
  /// Once in each cycle.
  void look();
  struct Wrong {
    double at = 0;         ///< s since the start
    std::uint16_t kind{};  ///< of the part
    std::string said;      ///< by the picker
  };
  /// Each part once for each time that it was said.
  const std::vector<Wrong>& wrong() const { return wrong_; }

 private:
  void judge();
  bool is_on_table(const user::ObjectTrack& part) const;

  visual_servoing::ServoingCell& cell_;
  std::vector<Wrong> wrong_;
  std::array<bool, 12> counted_{};
  user::PickerState state_ = user::PickerState::off;
  bool at_look_out_ = false;
};

}  // namespace flexrf::bench
