// A Robotiq two-finger gripper that exists in memory only: what its registers do.
#pragma once

#include <atomic>
#include <mutex>

#include "hal/gripper/interface/finger_model.hpp"
#include "hal/gripper/robotiq/robotiq_registers.hpp"
#include "hal/modbus/link/interface/modbus_station_model.hpp"

namespace flexrf::robotiq {

struct ModelPlan {
  double open_width = 0.085;  ///< m, at open_count
  double closed_width = 0;    ///< m, at closed_count
  std::uint8_t open_count = 0;
  std::uint8_t closed_count = 255;
  double slowest = 0.02;        ///< m/s, at count 0
  double fastest = 0.15;        ///< m/s, at count 255
  double activation_speed = 1;  ///< m/s: all the way to both ends; a real one takes seconds
  double object_width = 0;      ///< m: lies there whenever the fingers begin to close; 0: none
  /// Between two requests no more time passes for the fingers, however long it took.
  Duration longest_step = Duration::max();
};

/// As after power-on: not activated, open. Its time is that of the requests. Any thread.
class RobotiqModel final : public ModbusStationModel {
 public:
  explicit RobotiqModel(const ModelPlan& plan) noexcept;

  void follow(Time now, std::span<std::uint16_t> holding) noexcept override;

  double fingers();
  void put_object(double width);
  void put_around(double room);
  void take_away();
  /// The motor turns and the fingers do not: it says that it moves, without end.
  void set_stuck(bool on);
  /// gFLT, until it is activated anew; 0: none.
  void set_fault(std::uint8_t fault);
  /// It has forgotten everything, and is not activated. The fingers stay.
  void switch_off_and_on();

  // The same, for a thread that must not wait: it comes true before the next answer.

  void want_taken() noexcept { taken_.store(true, std::memory_order_release); }
  /// As set_stuck() where it is another than before.
  void want_stuck(bool on) noexcept { stuck_.store(on, std::memory_order_release); }
  /// Not 0.
  void want_fault(std::uint8_t fault) noexcept { fault_.store(fault, std::memory_order_release); }

 private:
  void disturb() noexcept;
  void take(const Action& action) noexcept;
  void move(Duration elapsed) noexcept;
  std::uint8_t count() const noexcept;
  double opening_of(std::uint8_t count) const noexcept;

  std::mutex mutex_;  // of everything
  ModelPlan plan_;
  FingerModel fingers_;
  Action action_;
  Told told_;
  int activation_part_ = 0;  // opening, closing, opening again
  bool forgets_ = false;
  Time now_{};
  bool was_stuck_ = false;  // as was wanted last

  // What is wanted; without the mutex.
  std::atomic<bool> taken_{false};
  std::atomic<bool> stuck_{false};
  std::atomic<std::uint8_t> fault_{0};
};

}  // namespace flexrf::robotiq
