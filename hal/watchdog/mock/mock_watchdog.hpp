// MockWatchdog: a timer that resets nothing, and says when it would have.
#pragma once

#include <atomic>

#include "hal/watchdog/interface/watchdog_feeding.hpp"
#include "mock_watchdog_driver.hpp"

namespace flexrf {

/// What a test makes it be. Before initialise().
struct MockWatchdogScript {
  std::uint32_t longest_timeout = 2046;  ///< s
  bool warns = true;                     ///< it has a pretimeout
  bool caused_last_reset = false;
  Status refusal;  ///< what arming fails with; ok: it does not
};

/// It counts from the first cycle after it was armed, as nobody knows the time before.
class MockWatchdog final : public WatchdogFeeding<MockWatchdogDriver> {
 public:
  void stop() override {
    if (!configuration.leave_armed) armed_ = false;
    feedback.armed = armed_;
  }

  // ---- for tests

  MockWatchdogScript script;
  /// Feeding fails from now on. Any thread.
  void break_off() noexcept { broken_ = true; }
  /// Any thread.
  bool is_armed() const noexcept { return armed_; }
  /// When it would reset the machine, or has; max(): it does not count. Any thread.
  Time resets_at() const noexcept { return armed_ ? Time{Duration{resets_at_.load()}} : Time::max(); }
  std::uint64_t times_fed() const noexcept { return fed_; }
  /// It was fed too late: the machine would have been reset. Any thread.
  bool was_late() const noexcept { return late_; }

 private:
  Status arm() override {
    if (!script.refusal.is_ok()) return script.refusal;
    if (configuration.timeout > script.longest_timeout) {
      return Status::error(StatusCode::out_of_range, "timeout: this watchdog takes at most %u s",
                           script.longest_timeout);
    }
    feedback.timeout = configuration.timeout;
    feedback.pretimeout = script.warns ? configuration.pretimeout : 0;
    feedback.caused_last_reset = script.caused_last_reset;
    resets_at_ = nanoseconds(Time::max());
    late_ = false;
    armed_ = true;
    return {};
  }
  bool feed(Time now) noexcept override {
    if (broken_) {
      fail(Status::error(StatusCode::unavailable, "scripted: the watchdog cannot be fed"));
      return false;
    }
    if (nanoseconds(now) > resets_at_) late_ = true;
    resets_at_ = nanoseconds(now + std::chrono::seconds{feedback.timeout});
    ++fed_;
    return true;
  }

  std::atomic<bool> armed_{false};
  std::atomic<bool> late_{false};
  std::atomic<bool> broken_{false};
  std::atomic<std::int64_t> resets_at_{0};  // ns
  std::atomic<std::uint64_t> fed_{0};
};

}  // namespace flexrf
