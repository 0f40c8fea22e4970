// An axis as a driver uses it and the simulated drive, in cycles of 7 ms on a wire that sends by priority.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include "hal/canopen/servo_axis.hpp"
#include "hal/servo_drive/canopen/simulator/simulated_cia402_drive.hpp"

namespace flexrf {

using canopen::Message;
using canopen::Outbox;
using canopen::cia402::AxisPlan;
using canopen::cia402::DriveState;
using canopen::cia402::Mode;
using canopen::cia402::ServoAxis;
using std::chrono::milliseconds;

inline constexpr std::uint8_t node = 5;
inline constexpr double resolution = 0.001;  // unit: an increment

inline AxisPlan plan() {
  AxisPlan result;
  result.node = node;
  result.vendor = 0x123;
  result.product = 0x456;
  result.increments_per_unit = -1000;
  result.lowest = -10;
  result.highest = 10;
  result.fastest = 20;
  return result;
}

struct Cell {
  explicit Cell(const AxisPlan& with = plan(), const SimulatedCia402Drive::Options& options = {.node = node})
      : drive{options} {
    drive.power_on(now);
    began = axis.begin(with, now, said);
  }

  void step() {
    // What the master says leaves by priority: SYNC before process data, whoever said it first.
    std::vector<Message> frames;
    for (; !said.is_empty(); said.pop()) frames.push_back(said.front());
    std::stable_sort(frames.begin(), frames.end(), [](const Message& one, const Message& other) {
      return one.identifier < other.identifier;
    });
    for (const Message& frame : frames) {
      const bool passes = cable && (syncs || frame.identifier != canopen::sync_identifier) && !is_lost(frame);
      if (passes) drive.receive(frame, now, heard);
    }
    for (int ms = 0; ms < 7; ++ms) {
      now += milliseconds(1);
      drive.advance(now, heard);
    }
    for (; !heard.is_empty(); heard.pop()) {
      if (cable && !is_lost(heard.front())) axis.receive(heard.front(), now, said);
    }
    if (position) axis.command_position(*position);
    if (velocity) axis.command_velocity(*velocity);
    axis.send(may_move, now, milliseconds(7), said);
  }
  void run(int ms) {
    for (int i = 0; i < ms; i += 7) step();
  }
  bool run_until_enabled() {
    may_move = true;
    for (int i = 0; i < 500 && axis.fault().is_ok() && !axis.is_enabled(); ++i) step();
    return axis.is_enabled();
  }
  bool is_lost(const Message& message) const { return lost && message.identifier == *lost; }
  bool is_at(double expected) const {
    return axis.state() && std::abs(axis.state()->position - expected) <= resolution;
  }
  bool fault_says(const char* words) const { return std::strstr(axis.fault().cause(), words) != nullptr; }
  // As an operator who has removed the cause.
  void begin_again() {
    may_move = false;
    began = axis.begin(plan(), now, said);
    run(1500);
  }

  Time now{std::chrono::seconds(1)};
  SimulatedCia402Drive drive;
  ServoAxis axis;
  Status began;
  Outbox said;
  Outbox heard;
  bool cable = true;
  bool syncs = true;
  std::optional<std::uint32_t> lost;  // messages of this identifier do not arrive
  bool may_move = false;
  std::optional<double> position;
  std::optional<double> velocity;
};

}  // namespace flexrf
