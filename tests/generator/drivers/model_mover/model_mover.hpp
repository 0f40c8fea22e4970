#pragma once

#include <chrono>

#include "model_mover_driver.hpp"

namespace flexrf::user {

class ModelMover final : public ModelMoverDriver {
 public:
  void go(double x) noexcept override {
    truth.publish({++number_, x});
    calls.push({number_, x});
  }
  void receive(const Tick& tick) noexcept override {
    if (const View<WayMark> mark = scene.latest(); mark && mark.is_new()) ++feedback.scenes;
    WayMark before;
    if (scene.at(tick.now - std::chrono::milliseconds(20), before) == NullReason::none)
      feedback.past = before.number;
    if (kept.latest()) kept.keep();
    if (const View<WayMark> mark = kept.kept(); mark) feedback.kept = mark->number;
    if (missing.latest().reason() != NullReason::not_registered)
      fail(Status::error(StatusCode::internal, "not possible"));
  }

 private:
  std::uint32_t number_ = 0;
};

}  // namespace flexrf::user
