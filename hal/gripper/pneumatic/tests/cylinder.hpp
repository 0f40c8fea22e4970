// Cylinder: what a pneumatic gripper's four lines are connected to.
#pragma once

#include "hal/gripper/conformance/gripper_conformance.hpp"
#include "hal/gripper/interface/finger_model.hpp"

namespace flexrf {

struct Valves {
  bool open = false;
  bool close = false;
};
struct ReedSwitches {
  bool open = false;
  bool closed = false;
};

class Cylinder {
 public:
  /// `closed_centre`: with both valves off it stops; else it goes on.
  explicit Cylinder(bool closed_centre) : closed_centre_(closed_centre) {}

  FingerModel& fingers() { return fingers_; }
  void set_air(bool on) { fingers_.set_stuck(!on); }
  /// The contacts of both are welded.
  void break_switches(bool on) { broken_ = on; }
  /// Both valves have been on at once.
  bool was_torn() const { return torn_; }

  ReedSwitches follow(const Valves& valves, Duration elapsed) {
    torn_ = torn_ || (valves.open && valves.close);
    if (valves.open != valves.close) spool_ = valves.open ? 1 : -1;
    if (closed_centre_ && !valves.open && !valves.close) spool_ = 0;
    if (spool_ != 0) {
      const double target = spool_ > 0 ? GripperSetting::open_width : GripperSetting::closed_width;
      fingers_.move(target, GripperSetting::speed, elapsed);
    }
    const double opening = fingers_.opening();
    return {broken_ || opening > GripperSetting::open_width - reach,
            broken_ || opening < GripperSetting::closed_width + reach};
  }

 private:
  static constexpr double reach = 5e-4;  // of a reed switch

  bool closed_centre_;
  FingerModel fingers_{GripperSetting::closed_width, GripperSetting::open_width};
  int spool_ = 0;
  bool broken_ = false;
  bool torn_ = false;
};

}  // namespace flexrf
