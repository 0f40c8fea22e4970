// MockPointer: a pointer that a test moves.
#pragma once

#include "hal/driver/mock/mock_plan.hpp"
#include "hal/operator/pointer/interface/pointer.hpp"
#include "hal/operator/pointer/interface/pointer_tracker.hpp"
#include "mock_pointer_driver.hpp"

namespace flexrf {

/// What a hand does: between cycles, from the thread the pointer lives in, or planned.
class MockPointer final : public MockPointerDriver {
 public:
  Status initialise() override {
    hand_ = {};
    hand_.appear();
    plan_.rewind();
    feedback = {};
    return refusal_;
  }
  void receive(const Tick& tick) noexcept override {
    plan_.follow(*this, tick.now);
    told_ = hand_.state();
    feedback.present = told_.present;
    motion.publish(told_, tick.now);
  }
  Time next_event() const noexcept override { return plan_.next_event(); }
  const PointerState& state() const noexcept override { return told_; }

  // ---- for tests

  void move(std::int64_t x, std::int64_t y) noexcept { hand_.move(x, y); }
  void turn_wheel(int detents) noexcept { hand_.turn(detents * 120, 0); }
  void press(std::size_t button) noexcept { hand_.press(button); }
  void let_go(std::size_t button) noexcept { hand_.let_go(button); }
  void unplug() noexcept {
    hand_.vanish();
    ++feedback.losses;
  }
  void plug_in() noexcept { hand_.appear(); }
  void plan(Duration after, void (*act)(MockPointer&)) { plan_.plan(after, act); }
  /// What initialise() is to answer.
  void refuse(const Status& refusal) noexcept { refusal_ = refusal; }

 private:
  PointerTracker hand_;
  PointerState told_{};
  MockPlan<MockPointer> plan_;
  Status refusal_;
};

}  // namespace flexrf
