// Jog: key presses move a target pose; arrows, as long as they are held, give the tool a velocity.
//
// A held arrow is no target: nothing can run ahead of the arm, and when the hold ends, for whatever reason,
// the wanted velocity is zero in the next step.
#pragma once

#include <optional>

#include "jog_unit.hpp"

namespace flexrf::user {

class Jog final : public JogUnit {
 public:
  Status initialise() override;
  void step(const Tick& tick) override;
  bool is_idle() const noexcept override { return keys.is_empty(); }

 private:
  bool publish_velocity(const Tick& tick);
  void heed_answer();

  std::optional<Pose> target_;
  bool left_behind_ = false;    // the arm was moved by a velocity since the target was seeded
  bool was_inhibited_ = false;  // in the step before
};

}  // namespace flexrf::user
