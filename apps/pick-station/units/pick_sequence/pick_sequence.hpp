// PickSequence: PickMachine at the ports of its unit.
#pragma once

#include "apps/pick-station/units/pick_sequence/pick_machine.hpp"
#include "pick_sequence_unit.hpp"

namespace flexrf::user {

class PickSequence final : public PickSequenceUnit {
 public:
  Status initialise() override;
  void step(const Tick& tick) override;
  bool is_idle() const noexcept override { return machine_.is_at_rest(); }

 private:
  PickView look(const Tick& tick) noexcept;
  PickWishes wishes() const noexcept;
  void command() noexcept;
  void tell(const PickView& view, const PickWishes& wished) noexcept;
  TowerSignal lamps(const PickView& view) const noexcept;

  PickMachine machine_;
  GantryState gantry_now_{};
  std::size_t part_present_ = 0;  // registers of the station
  std::size_t next_part_ = 0;
};

}  // namespace flexrf::user
