#pragma once

#include "station_interface.hpp"

namespace flexrf::user {

class Station : public StationInterface {
 public:
  using StationInterface::StationInterface;

  virtual double output() const noexcept = 0;

  // What all its drivers have in common, whichever it is.

  void count_transfer() noexcept { ++feedback.transfers; }
  void forget() noexcept { feedback = {}; }
  Status accept(const StationRuntime& proposed) override {
    if (proposed.setpoint != 6.5) return {};
    return Status::error(StatusCode::invalid_argument, "at 6.5 V its line rings");
  }
};

}  // namespace flexrf::user
