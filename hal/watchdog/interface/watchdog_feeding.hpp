// WatchdogFeeding: a driver of Watchdog over a generated base: when it is fed, and when that is withheld.
#pragma once

#include <algorithm>
#include <string_view>

#include "base/text.hpp"
#include "hal/watchdog/interface/watchdog.hpp"

namespace flexrf {

/// What differs between drivers is the timer.
template <class Base>
class WatchdogFeeding : public Base {
 public:
  Status initialise() override {
    if (this->configuration.pretimeout >= this->configuration.timeout) {
      return Status::error(StatusCode::invalid_argument,
                           "pretimeout (%u s) must be shorter than timeout (%u s): it is how long before the "
                           "reset the kernel is warned",
                           this->configuration.pretimeout, this->configuration.timeout);
    }
    this->feedback = {};
    if (const Status status = arm(); !status) return status;
    this->feedback.armed = true;
    this->feedback.least_left = this->feedback.timeout;
    interval_ = Duration{std::chrono::seconds{this->feedback.timeout}} / feedings_per_timeout;
    fed_at_ = next_ = Time{};
    if (Heartbeat* heartbeat = this->environment().heartbeat; heartbeat != nullptr) heartbeat->watch();
    return {};
  }

  void receive(const Tick& tick) noexcept override {
    if (tick.now < next_) return;
    const Heartbeat* heartbeat = this->environment().heartbeat;
    if (heartbeat != nullptr && !heartbeat->is_met(tick.now)) return withhold(tick.now, *heartbeat);
    if (!feed(tick.now)) return;
    if (fed_at_ != Time{}) {
      const double left = this->feedback.timeout - seconds(tick.now - fed_at_);
      this->feedback.least_left = std::min(this->feedback.least_left, left);
    }
    ++this->feedback.fed;
    fed_at_ = tick.now;
    next_ = tick.now + interval_;
  }

  Time next_event() const noexcept override { return next_; }

 protected:
  /// Opens and arms it as the configuration says; fills in timeout, pretimeout and caused_last_reset of the
  /// feedback. Not armed after an error.
  virtual Status arm() = 0;
  /// False: it could not be fed, and the device is in fault.
  virtual bool feed(Time now) noexcept = 0;

 private:
  /// So often its thread, which is not real-time, may come late by a half of the time-out and more.
  static constexpr int feedings_per_timeout = 4;

  void withhold(Time now, const Heartbeat& heartbeat) noexcept {
    ++this->feedback.withheld;
    const char* const missed_by = heartbeat.missed_by();
    set_text(this->feedback.missed_by,
             std::string_view{missed_by != nullptr ? missed_by : "who supervises the threads"});
    // Who comes back in time is not to wait for the next feeding.
    next_ = now + interval_ / feedings_per_timeout;
  }

  Duration interval_{};
  Time fed_at_{};  // no time: not since it was armed
  Time next_ = Time::max();
};

}  // namespace flexrf
