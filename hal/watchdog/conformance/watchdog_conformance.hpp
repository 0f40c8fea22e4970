// What every driver of Watchdog must do. A driver's test makes a world, which is the driver, its timer and
// the application's heartbeat, and runs the cases in it.
#pragma once

#include <memory>
#include <optional>

#include "hal/driver/device_bench.hpp"
#include "hal/watchdog/interface/watchdog.hpp"

namespace flexrf {

struct WatchdogSettings {
  std::uint32_t timeout = 10;  ///< s
  std::uint32_t pretimeout = 0;
  bool leave_armed = false;
};

class WatchdogWorld {
 public:
  virtual ~WatchdogWorld() = default;

  virtual Status start(const WatchdogSettings& settings) = 0;
  virtual Watchdog& watchdog() = 0;
  virtual const WatchdogInterface::Feedback& feedback() = 0;
  /// Its thread's cycle, so long after the last one, while `missed_by` is silent (null: nobody is).
  virtual void cycle(Duration elapsed, const char* missed_by) = 0;
  /// What the timer says, whatever the driver believes.
  virtual bool counts() = 0;
  /// The longest time-out that the timer takes, s; nothing: it takes whatever it is told.
  virtual std::optional<std::uint32_t> longest() = 0;

  // Before start(). False: cannot be made to happen here.
  virtual bool occupy() { return false; }     ///< somebody else has it
  virtual bool forbid() { return false; }     ///< the right to use it is missing
  virtual bool take_away() { return false; }  ///< there is none
};

/// With a driver that a bench can hold.
template <class Driver>
class WatchdogBenchWorld : public WatchdogWorld {
 public:
  WatchdogBenchWorld() { bench_.environment().heartbeat = &heartbeat_; }
  Status start(const WatchdogSettings& settings) override {
    bench_.configuration().timeout = settings.timeout;
    bench_.configuration().pretimeout = settings.pretimeout;
    bench_.configuration().leave_armed = settings.leave_armed;
    return driver().initialise();
  }
  Watchdog& watchdog() override { return driver(); }
  const WatchdogInterface::Feedback& feedback() override { return bench_.feedback(); }
  void cycle(Duration elapsed, const char* missed_by) override {
    heartbeat_.judge(bench_.now() + elapsed, missed_by);
    bench_.receive(elapsed);
    bench_.send();
  }

 protected:
  Driver& driver() { return bench_.driver(); }
  DeviceBench<Driver>& bench() { return bench_; }

 private:
  Heartbeat heartbeat_;
  DeviceBench<Driver> bench_{nullptr};
};

using MakeWatchdogWorld = std::unique_ptr<WatchdogWorld> (*)();

/// Runs all cases, each in a world of its own; returns the number that failed, for main().
int run_watchdog_conformance(const char* driver, MakeWatchdogWorld make);

}  // namespace flexrf
