// WrenchMeter: what all drivers of ForceTorqueSensor have in common, from what a sensor sends to what a unit
// sees: limits, tare, frame, age, and what is counted.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "hal/force_torque/interface/force_torque_sensor.hpp"

namespace flexrf {

/// In the sensor's own frame.
struct RawWrench {
  std::array<double, 3> force{};   ///< N
  std::array<double, 3> torque{};  ///< N m
  bool saturated = false;          ///< the sensor itself says that it is beyond what it measures
};

/// As the interface's configuration of these names.
struct MeterPlan {
  std::array<double, 3> position{};
  std::array<double, 4> orientation{};
  std::array<double, 3> force_limit{};
  std::array<double, 3> torque_limit{};
  std::uint32_t tare_samples = 1;
  Duration max_age{};
  Duration frozen_after{};  ///< 0: not judged
};

/// The thread of the sensor; begin(): the lifecycle thread.
class WrenchMeter {
 public:
  /// Forgets all. `name`: of the device, for the log; outlives this. Error: the plan makes no sense.
  Status begin(const char* name, const MeterPlan& plan) noexcept;

  // ---- what came, in its order

  /// `missed`: so many before it were sent and did not come whole.
  void take(const RawWrench& raw, Time at, std::uint64_t missed = 0) noexcept;
  /// The sensor is heard, and says that it cannot measure.
  void take_fault(const Status& fault, Time at) noexcept;
  void note_damaged(std::uint64_t count = 1) noexcept { told_.damaged += count; }
  void note_foreign() noexcept { ++told_.foreign; }
  /// Why nothing comes, until something does: told when the newest is too old.
  void note_away(const Status& why) noexcept { away_ = why; }
  /// After all of a cycle.
  void close(Time now) noexcept;

  // ---- what there is

  const std::optional<Wrench>& state() const noexcept { return state_; }
  Duration age() const noexcept { return age_; }
  const Status& trouble() const noexcept { return trouble_; }
  void fill(ForceTorqueSensorFeedback& feedback) const noexcept;

  void tare() noexcept;
  void clear_tare() noexcept;
  bool is_taring() const noexcept { return taring_ > 0; }

 private:
  void judge(const RawWrench& raw) noexcept;
  void weigh(const RawWrench& raw) noexcept;
  void give_up_tare(const char* why) noexcept;
  Wrench in_frame(const RawWrench& raw) const noexcept;
  Status trouble_now(Time now) const noexcept;

  const char* name_ = "";
  MeterPlan plan_;
  std::array<double, 9> rotation_{};  // row by row
  RawWrench bias_;
  RawWrench sum_;
  std::uint32_t taring_ = 0;  // so many measurements are still to come

  Time heard_{};     // a measurement or a fault
  Time measured_{};  // a measurement
  Time changed_{};   // likewise, another than the one before
  RawWrench before_;
  Wrench newest_{};
  Status fault_;
  Status away_;
  Status overload_;

  std::optional<Wrench> state_;
  Duration age_ = Duration::max();
  Status trouble_;
  bool was_heard_ = false;          // before, it was not there yet, which is no trouble
  ForceTorqueSensorFeedback told_;  // but for what is of this cycle, which fill() adds
};

}  // namespace flexrf
