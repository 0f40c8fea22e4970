#pragma once

#include "model_scenery_driver.hpp"

namespace flexrf::user {

class ModelScenery final : public ModelSceneryDriver {
 public:
  void receive(const Tick& tick) noexcept override {
    while (calls.pop()) ++feedback.calls;
    const View<WayMark> mark = truth.latest();
    feedback.reason = static_cast<std::uint8_t>(mark.reason());
    if (Loan<WayMark> loan = scene.loan(); loan) {
      *loan = {++number_, mark ? mark->x : 0.0};
      loan.publish(tick.now);
    }
  }

 private:
  std::uint32_t number_ = 0;
};

}  // namespace flexrf::user
