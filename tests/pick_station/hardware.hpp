// What the tests of the station need to know of the hardware that they run on.
#pragma once

#include <array>
#include <optional>

#include "hal/servo_drive/interface/servo_drive.hpp"
#include "tests/pick_station/mock_world.hpp"
#include "tests/pick_station/station_in_virtual_time.hpp"

namespace flexrf {
struct CameraCable;
}

namespace flexrf::pick_station {

enum class Hardware { mock, simulated };

/// Of virtual time, for any of these tests: the end of patience.
constexpr Duration long_enough = std::chrono::minutes(30);

constexpr int with_a_fault = 2;  // the exit code

/// A station and what is around it. On simulated hardware the simulated devices are all there is.
class Cell {
 public:
  explicit Cell(Hardware hardware, const Feeder::Settings& feeder = {});

  StationInVirtualTime& station() { return station_; }
  /// Null on simulated hardware.
  MockWorld* world() { return world_ ? &*world_ : nullptr; }
  RunSummary run(Duration longest);

  void trip_drive(const char* axis);
  /// Simulated, once it runs: a drive of this vendor is connected instead, and boots.
  void connect_drive_of(std::uint32_t vendor, const char* axis);
  /// Simulated: the application's plug on the bus. Mock: neither drive is heard.
  void plug_can(bool in);
  /// The gripper's serial line, the IO station's connection. The mocks have none: they are not heard, or what
  /// they were told is lost.
  void plug_gripper(bool in);
  void plug_station(bool in);
  void trip_gripper();
  CameraCable& camera();
  /// With what it looks at, the camera sees a part now and then, and now and then none.
  void make_camera_see();
  void silence_station(bool silent);
  void fill_feeder(std::uint32_t parts);
  /// Out of the fingers.
  void lose_part();
  double position_of(const char* axis);
  /// Where the axis really is, also when nobody hears of it.
  double true_position_of(const char* axis);

 private:
  void cut(const char* link, bool cut);

  StationInVirtualTime station_;
  std::optional<MockWorld> world_;
  std::array<std::optional<ServoState>, 2> unheard_;  // of the mocks' drives, while their cable is out
};

}  // namespace flexrf::pick_station
