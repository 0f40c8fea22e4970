// For tests of units: slots at their ports, and steps by hand.
#pragma once

#include <optional>

#include "runtime/blackboard/ports.hpp"
#include "runtime/unit/unit.hpp"

namespace flexrf {

/// A slot of one reader. The other end is the test's.
template <class T>
class SlotBench {
 public:
  SlotControl& control() { return slot_.control(); }
  /// For the binding of a unit's input.
  InputBinding input(Duration max_age = {}) { return {&reader_, 1, max_age, nullptr}; }

  /// Of a type that is as large as its slot says: an item of the usual size (SizedItem).
  void publish(const T& value, Time at) {
    const std::uint8_t buffer = control().loan();
    std::memcpy(control().payload(buffer), &value, control().type()->size);
    control().publish(buffer, at);
  }
  /// What a unit published last.
  std::optional<T> latest() {
    control().take(held_);
    if (held_ == SlotControl::none) return std::nullopt;
    T value;
    std::memcpy(&value, control().payload(held_), sizeof(T));
    return value;
  }
  /// When what latest() gave last was true; no time: it gave nothing.
  Time sampled_at() { return held_ == SlotControl::none ? Time{} : control().header(held_).sampled_at; }

 private:
  Slot<T, 1> slot_;
  SlotReader reader_{&slot_.control()};
  std::uint8_t held_ = SlotControl::none;
};

/// A unit and the clock of its thread. The test connects it and calls step().
template <class UnitType>
class UnitBench {
 public:
  UnitType& unit() { return unit_; }
  StepContext& context() { return context_; }
  Tick& tick() { return tick_; }
  Time now() const { return tick_.now; }

  auto& runtime() { return *static_cast<typename UnitType::Runtime*>(unit_.parameter_memory().runtime); }
  const auto& feedback() {
    return *static_cast<const typename UnitType::Feedback*>(unit_.parameter_memory().feedback);
  }

  /// The next step, `elapsed` after the one before.
  void step(Duration elapsed) {
    tick_.now += elapsed;
    tick_.nominal = tick_.now;
    tick_.elapsed = tick_.number == 0 ? Duration{} : elapsed;
    context_.now = tick_.now;
    ++context_.step;
    unit_.step(tick_);
    ++tick_.number;
  }

 private:
  StepContext context_;
  Tick tick_{.nominal = Time{std::chrono::seconds(1)}, .now = Time{std::chrono::seconds(1)}};
  UnitType unit_;
};

}  // namespace flexrf
