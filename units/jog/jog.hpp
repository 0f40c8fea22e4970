// Jog: key presses move a target pose.
#pragma once

#include <optional>

#include "jog_unit.hpp"

namespace flexrf {

class Jog final : public JogUnit {
 public:
  Status initialise() override;
  void step(const Tick& tick) override;
  bool is_idle() const noexcept override { return keys.is_empty(); }

 private:
  std::optional<Pose> target_;
};

}  // namespace flexrf
