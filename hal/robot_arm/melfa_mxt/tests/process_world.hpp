// The controller is another process, which answers in its own cycle. The driver's clock is the machine's: for
// the guest, where it counts.
#pragma once

#include <poll.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <optional>

#include "hal/robot_arm/melfa_mxt/tests/melfa_controller.hpp"
#include "hal/robot_arm/melfa_mxt/tests/melfa_world.hpp"
#include "places.hpp"
#include "tests/simulator_process.hpp"

namespace flexrf {

class ProcessWorld final : public MelfaWorld {
 public:
  ProcessWorld() {
    switch_on();
    initialise_arm(0.00711);
  }
  ~ProcessWorld() override { arm().stop(); }

  std::uint16_t port() const override { return port_; }
  std::string ask(std::string_view line) override { return controller_->ask(line); }

  /// As of a thread that its arm releases: not at once again, and not without an end.
  void receive() override {
    constexpr Duration min_interval = std::chrono::milliseconds(5);
    constexpr Duration timeout = std::chrono::milliseconds(15);
    const timespec pause = time_until(now() + min_interval);
    nanosleep(&pause, nullptr);
    const timespec longest = time_until(now() + timeout);
    pollfd answer{arm().descriptor(), POLLIN, 0};
    ppoll(&answer, 1, &longest, nullptr);
    bench().receive(MonotonicClock::now() - now());
  }
  /// The driver waits for what has to arrive.
  void await_far_end() override {}

  SimulatorProcess& controller() { return *controller_; }
  /// Anew after controller().kill(), at the same port.
  void switch_on() {
    controller_.emplace(place::mxt_simulator, arguments_of_controller(port_, melfa_home()));
    port_ = static_cast<std::uint16_t>(std::atoi(controller_->first_line().c_str()));
  }

 private:
  static timespec time_until(Time then) {
    const std::int64_t left = std::max<std::int64_t>((then - MonotonicClock::now()).count(), 0);
    return {static_cast<time_t>(left / 1'000'000'000), static_cast<long>(left % 1'000'000'000)};
  }

  std::optional<SimulatorProcess> controller_;
  std::uint16_t port_ = 0;
};

}  // namespace flexrf
