// PartPicker: PickerMachine at the ports of its unit.
#pragma once

#include "part_picker_unit.hpp"
#include "units/part_picker/picker_machine.hpp"

namespace flexrf::user {

class PartPicker final : public PartPickerUnit {
 public:
  Status initialise() override;
  void step(const Tick& tick) override;
  bool is_idle() const noexcept override { return machine_.is_at_rest(); }

 private:
  PickerPlan plan() const noexcept;
  PickerWishes wishes() const noexcept;
  PickerView look(const Tick& tick, const View<TrackList>& seen, const View<RobotLead>& lead) noexcept;
  void command() noexcept;
  void tell(const PickerView& view, const View<TrackList>& seen) noexcept;

  KnownParts parts_;
  PickerMachine machine_;
  std::optional<std::uint64_t> frame_;  // of the last list of tracks
  std::int64_t led_by_picture_ = 0;     // time of the last picture that moved the arm, ns
};

}  // namespace flexrf::user
