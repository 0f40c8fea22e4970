// The pneumatic gripper on a chip, with a cylinder on its lines.
#pragma once

#include <limits>
#include <optional>

#include "hal/driver/device_bench.hpp"
#include "hal/gripper/pneumatic/pneumatic_gripper.hpp"
#include "hal/gripper/pneumatic/tests/cylinder.hpp"

namespace flexrf {

template <class Chip>
class PneumaticWorld : public GripperWorld {
 public:
  explicit PneumaticWorld(bool closed_centre) : closed_centre_(closed_centre), cylinder_(closed_centre) {}

  Status start(const GripperSetting& setting) override {
    connect(cylinder_.follow({}, Duration{}));
    if (const Status status = chip_.driver().initialise(); !status) return status;
    gripper_.emplace(nullptr, std::span<QueueSink* const>{}, &chip_.driver());
    configure_gripper(gripper_->configuration(), setting);
    gripper_->configuration().closed_centre = closed_centre_;
    return gripper_->driver().initialise();
  }
  Gripper& gripper() override { return gripper_->driver(); }
  void receive() override {
    const Duration elapsed = pass_time();
    if (is_there()) connect(cylinder_.follow(valves(), elapsed));
    chip_.receive(elapsed);
    gripper_->receive(chip_.now() - gripper_->now());
  }
  void send() override {
    gripper_->send();
    chip_.send();
  }
  Time now() const override { return chip_.now(); }
  /// No number once both valves have been on at once: no case passes then.
  double fingers() override {
    return cylinder_.was_torn() ? std::numeric_limits<double>::quiet_NaN() : cylinder_.fingers().opening();
  }

  bool put_object(double width) override {
    cylinder_.fingers().put_object(width);
    return true;
  }
  bool take_away() override {
    cylinder_.fingers().take_away();
    return true;
  }
  bool make(GripperFarEnd behaviour) override {
    switch (behaviour) {
      case GripperFarEnd::well:
        cylinder_.set_air(true);
        cylinder_.break_switches(false);
        return is_there() || plug_in();
      case GripperFarEnd::unplugged:
        return unplug();
      case GripperFarEnd::stuck:
        cylinder_.set_air(false);
        return true;
      case GripperFarEnd::switch_broken:
        cylinder_.break_switches(true);
        return true;
      case GripperFarEnd::silent:
      case GripperFarEnd::off:
      case GripperFarEnd::damaged:
      case GripperFarEnd::tripped:
        break;
    }
    return false;
  }

 protected:
  virtual Duration pass_time() = 0;
  virtual Valves valves() = 0;
  virtual void connect(const ReedSwitches& reeds) = 0;
  virtual bool is_there() = 0;
  virtual bool unplug() = 0;
  virtual bool plug_in() = 0;

  DeviceBench<Chip>& chip() { return chip_; }
  /// Before the chip goes.
  void end() {
    if (gripper_) gripper_->driver().stop();
    chip_.driver().stop();
  }

 private:
  bool closed_centre_;
  Cylinder cylinder_;
  DeviceBench<Chip> chip_{nullptr};
  std::optional<DeviceBench<PneumaticGripper>> gripper_;  // goes before its chip
};

}  // namespace flexrf
