// A gripper that is an axis: its driver, its bus, and the drive at the far end, which is told by lines of
// text what its fingers meet and what goes wrong (drive_console.hpp).
#pragma once

#include <cmath>
#include <cstdlib>
#include <string>
#include <string_view>

#include "hal/gripper/canopen/canopen_gripper.hpp"
#include "hal/gripper/conformance/gripper_conformance.hpp"

namespace flexrf {

/// What the drive is like.
struct FingerAxis {
  double increments = 1e6;  ///< a metre of opening; negative: it counts up as it closes
  bool homes = false;       ///< it does not know where it is until it is homed; its home is closed
  bool has_torque = true;   ///< it can be told its greatest torque, and tells its torque
};

class AxisGripperWorld : public GripperWorld {
 public:
  static constexpr std::uint8_t node = 5;
  static constexpr Duration cycle = std::chrono::milliseconds(7);

  explicit AxisGripperWorld(const FingerAxis& axis) : axis_{axis} {}

  virtual CanopenGripper& driver() = 0;
  /// The far end's answer.
  virtual std::string ask(std::string_view line) = 0;
  bool tell(std::string_view line) { return ask(line) == "ok"; }
  /// The cable between both, or what comes next to it.
  virtual bool set_cable(bool in) = 0;
  /// Time passes, and this end neither receives nor sends.
  virtual void stall(Duration time) = 0;

  Gripper& gripper() override { return driver(); }
  double fingers() override {
    const std::string state = ask("state");
    const std::size_t at = state.find(" at ");
    return at == std::string::npos ? std::nan("") : std::atof(state.c_str() + at + 4) / axis_.increments;
  }
  bool put_object(double width) override { return block(width, true); }
  bool put_around(double room) override { return block(room, false); }
  bool take_away() override { return tell("unblock"); }

  bool make(GripperFarEnd behaviour) override {
    const GripperFarEnd before = behaviour_;
    behaviour_ = behaviour;
    switch (behaviour) {
      case GripperFarEnd::well:
        return make_well(before);
      case GripperFarEnd::silent:
        return tell("silence");
      case GripperFarEnd::off:
        return tell("off");
      case GripperFarEnd::unplugged:
        return set_cable(false);
      case GripperFarEnd::stuck:
        // Without its torque, fingers that do not move are fingers on an object.
        return axis_.has_torque && tell("cut motor");
      case GripperFarEnd::tripped:
        return tell("trip 0x2310");
      case GripperFarEnd::damaged:
      case GripperFarEnd::switch_broken:
        break;
    }
    return false;
  }

 protected:
  void configure(CanopenGripper::Configuration& configuration, const GripperSetting& setting) const {
    configure_gripper(configuration, setting);
    configuration.node = node;
    configuration.vendor = 0x123;
    configuration.product = 0x456;
    configuration.increments_per_unit = axis_.increments;
    configuration.homing_method = axis_.homes ? 33 : 0;
    configuration.homing_speed = 0.1;
    configuration.limits_torque = configuration.tells_torque = axis_.has_torque;
  }

 private:
  bool make_well(GripperFarEnd before) {
    switch (before) {
      case GripperFarEnd::silent:
        return tell("speak");
      case GripperFarEnd::off:
        return tell("on");
      case GripperFarEnd::unplugged:
        return set_cable(true);
      case GripperFarEnd::stuck:
        return tell("join motor");
      case GripperFarEnd::tripped:
        return tell("heal");
      default:
        break;
    }
    return true;
  }
  bool block(double width, bool closing) {
    const bool below = closing == (axis_.increments > 0);
    return tell((below ? "block below " : "block above ") +
                std::to_string(std::lround(width * axis_.increments)));
  }

  FingerAxis axis_;
  GripperFarEnd behaviour_ = GripperFarEnd::well;
};

}  // namespace flexrf
