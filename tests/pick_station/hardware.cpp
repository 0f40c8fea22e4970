#include "tests/pick_station/hardware.hpp"

#include <string_view>
#include <utility>

#include "hal/canopen/object.hpp"
#include "tests/pick_station/devices.hpp"

namespace flexrf::pick_station {
namespace {

constexpr std::uint16_t over_current = 0x2310;  // CiA 402, error codes
constexpr std::uint8_t low_voltage = 0x0A;      // Robotiq, gFLT
constexpr std::array<const char*, 2> axes = {"axis_x", "axis_z"};
constexpr double increments_per_metre = 100'000;  // as in apps/pick-station/pick_station.toml

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

void Cell::connect_drive_of(std::uint32_t vendor, const char* axis) {
  SimulatedCia402Drive& drive = station_.device<SimulatedServoDrive>(axis).far_end().drive();
  drive.objects().set_first(canopen::objects::vendor, vendor);
  drive.power_on(station_.now());
}

void Cell::plug_can(bool in) {
  if (!world_) return station_.device<InProcessCanBus>("can").station().set_connected(in);
  for (std::size_t i = 0; i < unheard_.size(); ++i) {
    auto& drive = station_.device<MockServoDrive>(axes[i]);
    if (in) {
      drive.set_state(std::exchange(unheard_[i], std::nullopt));
    } else {
      drive.halt();  // it no longer hears us either
      unheard_[i] = drive.state();
      drive.set_state(std::nullopt);
    }
  }
}

void Cell::plug_gripper(bool in) {
  if (world_) {
    station_.device<MockGripper>("gripper").set_fault(in ? MockGripper::Fault::none
                                                         : MockGripper::Fault::silent);
  } else {
    cut("gripper_line", !in);
  }
}

void Cell::plug_station(bool in) {
  if (world_) {
    station_.device<MockModbusStation>("io_station")
        .set_fault(in ? MockModbusStation::Fault::none : MockModbusStation::Fault::disconnected);
  } else {
    cut("station_link", !in);
  }
}

void Cell::cut(const char* link, bool cut) {
  station_.device<SimulatedModbusLink>(link).registers().set_fault(cut ? ModbusWireFault::disconnected
                                                                       : ModbusWireFault::none);
}

void Cell::trip_gripper() {
  if (world_) {
    station_.device<MockGripper>("gripper").set_fault(MockGripper::Fault::tripped);
  } else {
    station_.device<SimulatedGripper>("gripper").model().set_fault(low_voltage);
  }
}

CameraCable& Cell::camera() {
  return world_ ? station_.device<MockCamera>("camera").cable()
                : station_.device<SimulatedCamera>("camera").cable();
}

void Cell::make_camera_see() {
  if (world_) return;  // its pictures become brighter and brighter, and dark again
  station_.set_of("watch", "part_is_bright", false);
  station_.set_of("watch", "threshold", 0.42);
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

double Cell::true_position_of(const char* axis) {
  if (world_) {
    const auto& state = unheard_[std::string_view{axis} == axes[0] ? 0 : 1];
    return state ? state->position : position_of(axis);
  }
  auto& drive = station_.device<SimulatedServoDrive>(axis).far_end().drive();
  return drive.motion().position() / increments_per_metre;
}

}  // namespace flexrf::pick_station
