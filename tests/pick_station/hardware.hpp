// What the tests of the station need to know of the hardware that they run on.
#pragma once

#include <optional>

#include "tests/pick_station/mock_world.hpp"
#include "tests/pick_station/station_in_virtual_time.hpp"

namespace flexrf::pick_station {

enum class Hardware { mock, simulated };

/// Of virtual time, for any of these tests: the end of patience.
constexpr Duration long_enough = std::chrono::minutes(30);

/// A station and what is around it. On simulated hardware the simulated devices are all there is.
class Cell {
 public:
  explicit Cell(Hardware hardware, const Feeder::Settings& feeder = {});

  StationInVirtualTime& station() { return station_; }
  /// Null on simulated hardware.
  MockWorld* world() { return world_ ? &*world_ : nullptr; }
  RunSummary run(Duration longest);

  void trip_drive(const char* axis);
  void silence_station(bool silent);
  void fill_feeder(std::uint32_t parts);
  /// Out of the fingers.
  void lose_part();
  double position_of(const char* axis);

 private:
  StationInVirtualTime station_;
  std::optional<MockWorld> world_;
};

}  // namespace flexrf::pick_station
