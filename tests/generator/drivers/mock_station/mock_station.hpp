#pragma once

#include "mock_station_driver.hpp"

namespace flexrf::user {

class MockStation final : public MockStationDriver {
 public:
  void receive(const Tick& /*tick*/) noexcept override {
    bus->transfer();
    count_transfer();
  }
  Options told() const noexcept { return options(); }
  double output() const noexcept override { return runtime.setpoint; }
};

}  // namespace flexrf::user
