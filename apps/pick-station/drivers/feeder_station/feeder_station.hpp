// FeederStation: the IO station of the cell, with the feeder that is behind it.
#pragma once

#include <memory>

#include "apps/pick-station/world/feeder.hpp"
#include "feeder_station_driver.hpp"
#include "hal/modbus/station/interface/linked_station.hpp"

namespace flexrf::user {

class FeederStation final : public LinkedStation<FeederStationDriver> {
 public:
  Status initialise() override;

  /// For tests: between the link's cycles, after initialise().
  Feeder& feeder() noexcept { return *feeder_; }

 private:
  std::shared_ptr<Feeder> feeder_;
};

}  // namespace flexrf::user
