#pragma once

#include "patient_unit.hpp"

namespace flexrf::user {

class Patient final : public PatientUnit {
 public:
  void step(const Tick& tick) override {
    ++feedback.steps;
    feedback.inhibited = tick.motion_inhibited;
    drive->command(tick.motion_inhibited || tick.stop_requested ? 0.0 : 1.0);
    if (runtime.falter > 0) fail(Status::error(StatusCode::internal, "faltered"));
    static_cast<void>(mark.latest());
  }
  bool is_idle() const noexcept override { return drive->speed() == 0; }
};

}  // namespace flexrf::user
