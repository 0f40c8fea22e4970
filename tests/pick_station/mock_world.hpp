// MockWorld: what is around the station when its devices are mocks: a feeder, parts, a gripper that has a
// part between its fingers only where one lies.
#pragma once

#include <array>

#include "apps/pick-station/world/feeder.hpp"
#include "tests/pick_station/station_in_virtual_time.hpp"

namespace flexrf::pick_station {

class MockWorld {
 public:
  explicit MockWorld(StationInVirtualTime& station, const Feeder::Settings& feeder = {});

  /// Between two cycles.
  void act(Time now);

  Feeder& feeder() { return feeder_; }
  /// It falls out of the fingers, or is not where it should be.
  void lose_part() { loses_part_ = true; }
  void hide_part(bool hidden) { part_is_hidden_ = hidden; }
  /// Of those that lie where they should: taken at the feeder, let go at the tray.
  int taken() const { return taken_; }
  int laid_down() const { return laid_down_; }
  int dropped_elsewhere() const { return dropped_; }

 private:
  StationInVirtualTime* station_;
  Feeder feeder_;
  std::array<std::uint16_t, 2> registers_{};
  bool released_ = false;
  bool holds_ = false;
  bool loses_part_ = false;
  bool part_is_hidden_ = false;
  int taken_ = 0;
  int laid_down_ = 0;
  int dropped_ = 0;
};

}  // namespace flexrf::pick_station
