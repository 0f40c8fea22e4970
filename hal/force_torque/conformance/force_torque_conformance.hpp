// What every driver of ForceTorqueSensor must do. A driver's test makes a world, which is the driver and the
// sensor at its other end, and runs the cases in it.
#pragma once

#include <memory>
#include <string_view>

#include "hal/force_torque/interface/force_torque_sensor.hpp"

namespace flexrf {

/// What the far end does from now on.
enum class SensorFarEnd : std::uint8_t {
  well,
  silent,     ///< sends nothing
  off,        ///< without power: sends nothing, and has forgotten what it was asked when it is well again
  unplugged,  ///< its line is cut
  damaged,    ///< sends what is no measurement
  truncated,  ///< its messages end early
  foreign,    ///< what comes is from somebody else
  saturated,  ///< says that its load is beyond what it measures
  faulty,     ///< says that it cannot measure
};

/// Of the driver's configuration.
struct ForceTorqueSetting {
  static constexpr std::uint32_t tare_samples = 5;
  std::array<double, 3> position{};
  std::array<double, 4> orientation{};
  double force_limit = 0;
  double torque_limit = 0;
};

template <class Configuration>
void configure_sensor(Configuration& configuration, const ForceTorqueSetting& setting, double max_age) {
  configuration.position = setting.position;
  configuration.orientation = setting.orientation;
  configuration.force_limit.fill(setting.force_limit);
  configuration.torque_limit.fill(setting.torque_limit);
  configuration.tare_samples = ForceTorqueSetting::tare_samples;
  configuration.max_age = max_age;
}

class ForceTorqueWorld {
 public:
  virtual ~ForceTorqueWorld() = default;

  virtual Status start(const ForceTorqueSetting& setting) = 0;
  virtual ForceTorqueSensor& sensor() = 0;
  virtual const ForceTorqueSensorFeedback& feedback() = 0;
  virtual ForceTorqueSensorRuntime& runtime() = 0;
  /// Where it publishes.
  virtual SlotControl* slot() = 0;
  /// One cycle.
  virtual void receive() = 0;
  virtual Time now() const = 0;
  /// A clock of its own, by which it may be judged how soon something happens.
  virtual bool has_virtual_time() const { return true; }

  /// On the sensor's own axes; hundredths of N and thousandths of N m are exact.
  virtual void load(const std::array<double, 3>& force, const std::array<double, 3>& torque) = 0;
  // False: cannot be made to happen with this driver.
  virtual bool make(SensorFarEnd behaviour) = 0;
  virtual bool lose(std::uint32_t /*count*/) { return false; }
};

using MakeForceTorqueWorld = std::unique_ptr<ForceTorqueWorld> (*)();

/// Runs all cases, each in a world of its own; returns the number that failed, for main().
int run_force_torque_conformance(const char* driver, MakeForceTorqueWorld make);

}  // namespace flexrf
