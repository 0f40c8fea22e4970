// ForceTorqueSensor: measures what pulls and turns at a flange.
#pragma once

#include <optional>

#include "force_torque_sensor_interface.hpp"
#include "types/wrench.hpp"

namespace flexrf {

/// Everything: the thread the sensor lives in. A sensor that is not there or falls silent is no fault of the
/// device: state() is nothing, trouble() says why, and both come back when it does.
class ForceTorqueSensor : public ForceTorqueSensorInterface {
 public:
  /// The newest measurement, in the configured frame and without the tare; nothing before the first one, when
  /// the newest is older than max_age, and while the sensor reports a fault of its own. With an overload the
  /// values are there and say so: they are not to be believed.
  virtual std::optional<Wrench> state() const noexcept = 0;
  /// Of the newest measurement, at this cycle; Duration::max(): none came yet.
  virtual Duration age() const noexcept = 0;
  /// What is wrong, and what a person can do; ok while nothing is. unavailable, not_permitted, device_fault,
  /// and out_of_range: an overload. It goes when the cause has gone.
  virtual const Status& trouble() const noexcept = 0;

  /// From the mean of the next tare_samples measurements on, what is measured now is nothing: the load is to
  /// rest meanwhile. Replaces the tare before. Given up, which the log says, when they cease to come, or one
  /// of them is an overload or a fault; the tare before then stays. A sensor that was away may have another
  /// offset: its tare is kept, and whether it still holds is the unit's to know.
  virtual void tare() noexcept = 0;
  virtual void clear_tare() noexcept = 0;
  virtual bool is_taring() const noexcept = 0;
};

}  // namespace flexrf
