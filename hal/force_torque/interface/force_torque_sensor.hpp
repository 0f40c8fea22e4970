// ForceTorqueSensor: measures what pulls and turns at a flange.
#pragma once

#include <optional>

#include "force_torque_sensor_interface.hpp"
#include "types/wrench.hpp"

namespace flexrf {

/// Everything: the thread the sensor lives in. A sensor that is not there or falls silent is no fault of the
/// device: state() is nothing, trouble() says why, and both come back when it does [force-torque-sensor-1].
class ForceTorqueSensor : public ForceTorqueSensorInterface {
 public:
  using ForceTorqueSensorInterface::ForceTorqueSensorInterface;

  /// The newest measurement, in the configured frame and without the tare [force-torque-sensor-2]; nothing
  /// before the first one, when the newest is older than max_age, and while the sensor reports a fault of its
  /// own [force-torque-sensor-3]. With an overload the values are there and say so [force-torque-sensor-4]:
  /// they are not to be believed.
  virtual std::optional<Wrench> state() const noexcept = 0;
  /// Of the newest measurement, at this cycle [force-torque-sensor-5]; Duration::max(): none came yet.
  virtual Duration age() const noexcept = 0;
  /// What is wrong, and what a person can do; ok while nothing is. unavailable, not_permitted, device_fault,
  /// and out_of_range: an overload. It goes when the cause has gone [force-torque-sensor-6].
  virtual const Status& trouble() const noexcept = 0;

  /// From the mean of the next tare_samples measurements on, what is measured now is
  /// nothing [force-torque-sensor-7]: the load is to rest meanwhile. Replaces the tare
  /// before [force-torque-sensor-8]. Given up, which the log says, when they cease to come, or one of them is
  /// an overload or a fault; the tare before then stays [force-torque-sensor-9]. A sensor that was away may
  /// have another offset: its tare is kept [force-torque-sensor-10], and whether it still holds is the unit's
  /// to know.
  virtual void tare() noexcept = 0;
  virtual void clear_tare() noexcept = 0;
  virtual bool is_taring() const noexcept = 0;
};

}  // namespace flexrf
