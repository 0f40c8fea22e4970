// SignalTower: three lamps that show how a cell is, and the emergency-stop input beside them.
#pragma once

#include "signal_tower_unit.hpp"

namespace flexrf::user {

class SignalTower final : public SignalTowerUnit {
 public:
  void step(const Tick& tick) override;

 private:
  bool is_lit(LampMode mode, Time now) const noexcept;
};

}  // namespace flexrf::user
