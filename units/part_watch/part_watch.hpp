// PartWatch: whether there is a part in a window of a picture, by the mean brightness there.
//
// It recognises nothing: light that changes, or a hand in the window, changes the answer. What it says is
// worth what the lighting is worth.
#pragma once

#include "part_watch_unit.hpp"

namespace flexrf::user {

class PartWatch final : public PartWatchUnit {
 public:
  void step(const Tick& tick) override;
};

}  // namespace flexrf::user
