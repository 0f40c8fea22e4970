#include "hal/force_torque/interface/wrench_meter.hpp"

#include <algorithm>
#include <cmath>

#include "runtime/log/log.hpp"

namespace flexrf {
namespace {

using Vector = std::array<double, 3>;

constexpr const char* axes[3] = {"x", "y", "z"};

Vector rotated(const std::array<double, 9>& rotation, const Vector& in) noexcept {
  Vector out{};
  for (std::size_t i = 0; i < 3; ++i)
    out[i] = rotation[3 * i] * in[0] + rotation[3 * i + 1] * in[1] + rotation[3 * i + 2] * in[2];
  return out;
}

std::array<double, 9> rotation_of(const std::array<double, 4>& quaternion) noexcept {
  const auto [x, y, z, w] = quaternion;
  if (x == 0 && y == 0 && z == 0 && w == 0) return {1, 0, 0, 0, 1, 0, 0, 0, 1};
  return {1 - 2 * (y * y + z * z), 2 * (x * y - z * w),     2 * (x * z + y * w),
          2 * (x * y + z * w),     1 - 2 * (x * x + z * z), 2 * (y * z - x * w),
          2 * (x * z - y * w),     2 * (y * z + x * w),     1 - 2 * (x * x + y * y)};
}

/// Which axis is beyond its limit; 3: none.
std::size_t beyond(const Vector& values, const Vector& limits) noexcept {
  for (std::size_t i = 0; i < 3; ++i)
    if (limits[i] > 0 && std::abs(values[i]) > limits[i]) return i;
  return 3;
}

bool are_limits(const Vector& limits) noexcept {
  for (const double limit : limits)
    if (!(std::isfinite(limit) && limit >= 0)) return false;
  return true;
}

}  // namespace

Status WrenchMeter::begin(const char* name, const MeterPlan& plan) noexcept {
  const auto [x, y, z, w] = plan.orientation;
  const double norm = x * x + y * y + z * z + w * w;
  if (norm != 0 && !(std::abs(norm - 1) < 1e-3)) {
    return Status::error(StatusCode::invalid_argument,
                         "configuration.orientation (%g, %g, %g, %g) is no unit quaternion x, y, z, w; all "
                         "zero means not turned",
                         x, y, z, w);
  }
  for (const double coordinate : plan.position) {
    if (!std::isfinite(coordinate))
      return Status::error(StatusCode::invalid_argument, "configuration.position is no place");
  }
  if (!are_limits(plan.force_limit) || !are_limits(plan.torque_limit)) {
    return Status::error(StatusCode::invalid_argument,
                         "configuration.force_limit and torque_limit are above 0, or 0 where none is judged");
  }
  *this = WrenchMeter{};
  name_ = name;
  plan_ = plan;
  rotation_ = rotation_of(plan.orientation);
  return {};
}

void WrenchMeter::take(const RawWrench& raw, Time at, std::uint64_t missed) noexcept {
  ++told_.samples;
  told_.lost += missed;
  heard_ = measured_ = at;
  const bool is_another = raw.force != before_.force || raw.torque != before_.torque;
  if (is_another || changed_ == Time{}) changed_ = at;
  before_ = raw;
  fault_ = away_ = {};
  judge(raw);
  if (taring_ > 0) weigh(raw);
  const std::uint64_t sequence = newest_.sequence + missed + 1;
  newest_ = in_frame(raw);
  newest_.time = nanoseconds(at);
  newest_.sequence = sequence;
  newest_.overload = !overload_.is_ok();
}

void WrenchMeter::take_fault(const Status& fault, Time at) noexcept {
  heard_ = at;
  away_ = {};
  fault_ = fault;
  give_up_tare("the sensor reports a fault");
}

/// Before any tare: what the sensor bears is not changed by what is taken off.
void WrenchMeter::judge(const RawWrench& raw) noexcept {
  const bool was_ok = overload_.is_ok();
  const std::size_t force = beyond(raw.force, plan_.force_limit);
  const std::size_t torque = beyond(raw.torque, plan_.torque_limit);
  if (raw.saturated) {
    overload_ = Status::error(StatusCode::out_of_range,
                              "the load is beyond what the sensor measures, as it says itself; unload it");
  } else if (force < 3) {
    overload_ =
        Status::error(StatusCode::out_of_range,
                      "a force of %.4g N along the sensor's %s is beyond its limit of %g N; unload it",
                      raw.force[force], axes[force], plan_.force_limit[force]);
  } else if (torque < 3) {
    overload_ = Status::error(StatusCode::out_of_range,
                              "a torque of %.4g N m about the sensor's %s is beyond its limit of %g N m; "
                              "unload it",
                              raw.torque[torque], axes[torque], plan_.torque_limit[torque]);
  } else {
    overload_ = {};
  }
  if (!overload_.is_ok()) give_up_tare("the load is beyond what may be measured");
  if (was_ok && !overload_.is_ok()) ++told_.overloads;
}

void WrenchMeter::weigh(const RawWrench& raw) noexcept {
  for (std::size_t i = 0; i < 3; ++i) {
    sum_.force[i] += raw.force[i];
    sum_.torque[i] += raw.torque[i];
  }
  if (--taring_ > 0) return;
  for (std::size_t i = 0; i < 3; ++i) {
    bias_.force[i] = sum_.force[i] / plan_.tare_samples;
    bias_.torque[i] = sum_.torque[i] / plan_.tare_samples;
  }
  told_.tared = true;
}

void WrenchMeter::tare() noexcept {
  if (!state_ || state_->overload) {
    log_warning(name_, "not tared: {}", trouble_.is_ok() ? "nothing is measured yet" : trouble_.cause());
    return;
  }
  sum_ = {};
  taring_ = plan_.tare_samples;
}

void WrenchMeter::clear_tare() noexcept {
  taring_ = 0;
  told_.tared = false;
  bias_ = {};
}

void WrenchMeter::give_up_tare(const char* why) noexcept {
  if (taring_ > 0) log_warning(name_, "not tared: {}", why);
  taring_ = 0;
}

Wrench WrenchMeter::in_frame(const RawWrench& raw) const noexcept {
  Vector force = raw.force;
  Vector torque = raw.torque;
  for (std::size_t i = 0; i < 3; ++i) {
    force[i] -= bias_.force[i];
    torque[i] -= bias_.torque[i];
  }
  force = rotated(rotation_, force);
  torque = rotated(rotation_, torque);
  const Vector& lever = plan_.position;
  Wrench wrench{};
  wrench.force = force;
  wrench.torque = {torque[0] + lever[1] * force[2] - lever[2] * force[1],
                   torque[1] + lever[2] * force[0] - lever[0] * force[2],
                   torque[2] + lever[0] * force[1] - lever[1] * force[0]};
  wrench.tared = told_.tared;
  return wrench;
}

Status WrenchMeter::trouble_now(Time now) const noexcept {
  if (heard_ != Time{} && now - heard_ <= plan_.max_age) {
    const bool is_frozen = plan_.frozen_after > Duration{} && measured_ - changed_ >= plan_.frozen_after;
    if (!fault_.is_ok() || !is_frozen) return fault_.is_ok() ? overload_ : fault_;
    return Status::error(
        StatusCode::device_fault,
        "it measures the same to the last digit for %g s: is the sensor frozen, or its cable "
        "out behind its electronics?",
        seconds(measured_ - changed_));
  }
  if (!away_.is_ok()) return away_;
  if (heard_ == Time{})
    return Status::error(StatusCode::unavailable,
                         "nothing is heard from the sensor; is it on, and its cable in?");
  return Status::error(StatusCode::unavailable,
                       "nothing is heard from the sensor for longer than %g s; is it on, and its cable in?",
                       seconds(plan_.max_age));
}

void WrenchMeter::close(Time now) noexcept {
  const StatusCode before = trouble_.code();
  trouble_ = trouble_now(now);
  age_ = measured_ == Time{} ? Duration::max() : std::max(now - measured_, Duration{});
  const bool usable = trouble_.is_ok() || trouble_.code() == StatusCode::out_of_range;
  state_.reset();
  if (usable) {
    state_ = newest_;
    was_heard_ = true;
  } else {
    give_up_tare(trouble_.cause());
  }
  if (was_heard_ && trouble_.code() != before) {
    // That it was not there yet is no trouble that it recovers from.
    if (!trouble_.is_ok()) {
      ++told_.troubles;
    } else if (told_.troubles > 0) {
      ++told_.recoveries;
    }
  }
}

void WrenchMeter::fill(ForceTorqueSensorFeedback& feedback) const noexcept {
  feedback = told_;
  feedback.force = newest_.force;
  feedback.torque = newest_.torque;
  feedback.present = state_.has_value();
  feedback.age = age_ == Duration::max() ? 0 : seconds(age_);
  feedback.overload = state_ && state_->overload;
  feedback.taring = taring_ > 0;
  feedback.force_tare = bias_.force;
  feedback.torque_tare = bias_.torque;
  feedback.set_trouble(trouble_.cause());
}

}  // namespace flexrf
