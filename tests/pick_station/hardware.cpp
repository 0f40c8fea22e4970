#include "tests/pick_station/hardware.hpp"

#include "tests/pick_station/devices.hpp"

namespace flexrf::pick_station {
namespace {

constexpr std::uint16_t over_current = 0x2310;  // CiA 402, error codes

}  // namespace

Cell::Cell(Hardware hardware, const Feeder::Settings& feeder)
    : station_(hardware == Hardware::mock ? "mock" : "simulated") {
  if (hardware == Hardware::mock) {
    world_.emplace(station_, feeder);
    return;
  }
  auto& far_end = station_.device<FeederStation>("io_station");
  static_cast<FeederStation::Configuration*>(far_end.parameter_memory().configuration)->stock = feeder.stock;
}

RunSummary Cell::run(Duration longest) {
  if (!world_) return station_.run(longest);
  return station_.run(longest, [this](Time now) { world_->act(now); });
}

void Cell::trip_drive(const char* axis) {
  if (world_) {
    station_.device<MockServoDrive>(axis).trip();
  } else {
    DriveOnCan& drive = station_.device<SimulatedServoDrive>(axis).far_end();
    drive.drive().trip(over_current, false, drive.said());
  }
}

void Cell::silence_station(bool silent) {
  if (world_) {
    station_.device<MockModbusStation>("io_station")
        .set_fault(silent ? MockModbusStation::Fault::silent : MockModbusStation::Fault::none);
  } else {
    station_.device<SimulatedModbusLink>("station_link")
        .registers()
        .set_fault(silent ? ModbusWireFault::silent : ModbusWireFault::none);
  }
}

void Cell::fill_feeder(std::uint32_t parts) {
  (world_ ? world_->feeder() : station_.device<FeederStation>("io_station").feeder()).fill(parts);
}

void Cell::lose_part() {
  if (world_) {
    world_->lose_part();
  } else {
    station_.device<SimulatedGripper>("gripper").model().take_away();
  }
}

double Cell::position_of(const char* axis) {
  const auto state = station_.device<ServoDrive>(axis).state();
  CHECK(state.has_value());
  return state->position;
}

}  // namespace flexrf::pick_station
