// What every driver of Gripper must do. A driver's test makes a world, which is the driver and what its
// fingers meet, and runs the cases in it.
#pragma once

#include <memory>

#include "hal/gripper/interface/gripper.hpp"
#include "types/gripper_safe_state.hpp"

namespace flexrf {

/// What the far end does from now on.
enum class GripperFarEnd : std::uint8_t {
  well,
  silent,         ///< is not heard, and goes on as it was told
  off,            ///< without power: not heard; has forgotten what it was told when it is well again
  unplugged,      ///< its line is cut, and it goes on as it was told
  damaged,        ///< answers with what is no answer
  stuck,          ///< the fingers do not move: no air, or a broken gear
  tripped,        ///< reports a fault of its own; with well its cause is gone
  switch_broken,  ///< its switches tell what cannot be
};

/// Of the driver's configuration.
struct GripperSetting {
  static constexpr double open_width = 0.08;
  static constexpr double closed_width = 0;
  static constexpr double speed = 0.15;
  static constexpr double force = 40;
  static constexpr double travel_timeout = 5;
  GripperSafeState safe_state = GripperSafeState::hold;
};

template <class Configuration>
void configure_gripper(Configuration& configuration, const GripperSetting& setting) {
  configuration.open_width = GripperSetting::open_width;
  configuration.closed_width = GripperSetting::closed_width;
  configuration.speed = GripperSetting::speed;
  configuration.force = GripperSetting::force;
  configuration.travel_timeout = GripperSetting::travel_timeout;
  configuration.safe_state = setting.safe_state;
}

class GripperWorld {
 public:
  virtual ~GripperWorld() = default;

  /// Initialised and permitted to move; open, with nothing between the fingers, at rest, as after power-on.
  virtual Status start(const GripperSetting& setting) = 0;
  virtual Gripper& gripper() = 0;
  /// The thread's cycle: receive, then what the unit does, then send.
  virtual void receive() = 0;
  virtual void send() = 0;
  virtual Time now() const = 0;
  /// Requests that the far end has answered so far, where a line takes time of its own; 0: what is sent is
  /// heard.
  virtual std::uint64_t exchanges() { return 0; }
  /// A clock of its own, by which it may be judged how soon something happens.
  virtual bool has_virtual_time() const { return true; }
  /// Where the fingers really are, m.
  virtual double fingers() = 0;

  // False: cannot be made to happen with this driver.
  virtual bool put_object(double /*width*/) { return false; }
  virtual bool put_around(double /*room*/) { return false; }
  virtual bool take_away() { return false; }
  virtual bool make(GripperFarEnd behaviour) = 0;
};

using MakeGripperWorld = std::unique_ptr<GripperWorld> (*)();

/// Runs all cases, each in a world of its own; returns the number that failed, for main().
int run_gripper_conformance(const char* driver, MakeGripperWorld make);

}  // namespace flexrf
