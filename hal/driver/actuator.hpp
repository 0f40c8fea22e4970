// Actuator: the rule that keeps people safe, once for everything that moves or switches something.
#pragma once

#include "runtime/device/device.hpp"

namespace flexrf {

/// Between the generated base of an interface and its drivers. It decides, and no driver decides otherwise:
///
/// - A unit's command is taken only while may_act(). Else it is without effect and not remembered: the
///   interface asks before its driver hears of the command.
/// - Only then act() sends what was commanded. Else rest() sends what holds, is off, or is safe, after
///   forget().
/// - make_safe() has the driver become safe. From then on it may not act, until the permission to move was
///   withdrawn and given again.
///
/// A driver fills in what it takes in and what it sends. Everything: the thread the device lives in; never
/// blocks, never allocates.
template <class Interface>
class Actuator : public Interface {
 public:
  /// The generator asks for this of a driver whose table says `actuates = true`.
  using Guard = Actuator;
  using Interface::Interface;

  void receive(const Tick& tick) noexcept final {
    see_permission();
    if (!may_act()) forget();
    take_in(tick);
  }
  void send(const Tick& tick) noexcept final {
    see_permission();
    if (may_act()) {
      act(tick);
    } else {
      forget();
      rest(tick);
    }
  }
  bool make_safe() noexcept final {
    made_safe_ = true;
    return become_safe();
  }

 protected:
  /// It may move or switch as it is commanded.
  bool may_act() const noexcept { return !this->is_inhibited() && this->fault().is_ok() && !made_safe_; }

 private:
  /// In receive(): what arrived.
  virtual void take_in(const Tick& /*tick*/) noexcept {}
  /// What was commanded and has not left is given up; called again in each cycle in which it may not act.
  virtual void forget() noexcept = 0;
  /// In send(), while may_act().
  virtual void act(const Tick& tick) noexcept = 0;
  /// In send(), while it may not act.
  virtual void rest(const Tick& tick) noexcept = 0;
  /// As Device::make_safe(); what was commanded is given up.
  virtual bool become_safe() noexcept = 0;

  void see_permission() noexcept {
    if (this->is_inhibited()) made_safe_ = false;
  }

  bool made_safe_ = false;
};

}  // namespace flexrf
