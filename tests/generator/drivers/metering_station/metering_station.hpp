#pragma once

#include "metering_station_driver.hpp"

namespace flexrf::user {

class MeteringStation final : public MeteringStationDriver {
 public:
  using MeteringStationDriver::accept;
  Status accept(const Runtime& proposed) override {
    if (const Status status = MeteringStationDriver::accept(proposed); !status) return status;
    if (proposed.setpoint + proposed.trim <= 10) return {};
    return Status::error(StatusCode::invalid_argument, "with its trim it puts out more than 10 V");
  }
  void receive(const Tick& /*tick*/) noexcept override {
    bus->transfer();
    count_transfer();
    feedback.online = true;
    feedback.metered = true;
    if (runtime.clear > 0) feedback.sum = 0;
    feedback.sum += output();
    if (runtime.settles && feedback.transfers == 10) runtime.trim = 0.125;
  }
  double output() const noexcept override { return runtime.setpoint + runtime.trim; }
};

}  // namespace flexrf::user
