#include "tests/pick_station/mock_world.hpp"

#include <cmath>

#include "tests/pick_station/devices.hpp"

namespace flexrf::pick_station {
namespace {

constexpr double part_width = 0.03;  // m
constexpr double near_by = 0.001;    // m

// As in apps/pick-station/pick_station.toml.
constexpr double depth = 0.2;
constexpr double feeder_place = 0.1;
constexpr double tray_place = 0.5;

}  // namespace

MockWorld::MockWorld(StationInVirtualTime& station, const Feeder::Settings& feeder)
    : station_(&station), feeder_(feeder) {}

void MockWorld::act(Time now) {
  if (!released_) {
    station_->press_emergency_stop(false);
    released_ = true;
  }
  auto& registers = station_->device<MockModbusStation>("io_station");
  registers_[Feeder::next_part] = static_cast<std::uint16_t>(registers.held(Feeder::next_part));
  feeder_.follow(now, registers_);
  registers.put(Feeder::part_present, registers_[Feeder::part_present]);

  const auto x = station_->device<MockServoDrive>("axis_x").state();
  const auto z = station_->device<MockServoDrive>("axis_z").state();
  auto& fingers = station_->device<MockGripper>("gripper").fingers();
  const auto is_at = [&](double place) {
    return x && z && std::abs(x->position - place) < near_by && std::abs(z->position - depth) < near_by;
  };
  const bool open = fingers.opening() > part_width + near_by;
  if (loses_part_) {
    fingers.take_away();
    holds_ = loses_part_ = false;
  } else if (!holds_ && !open && is_at(feeder_place) && registers_[Feeder::part_present] != 0 &&
             !part_is_hidden_) {
    fingers.put_object(part_width);
    holds_ = true;
    ++taken_;
  } else if (holds_ && open) {
    fingers.take_away();
    holds_ = false;
    ++(is_at(tray_place) ? laid_down_ : dropped_);
  }
}

}  // namespace flexrf::pick_station
