// Device: a generic interface to something outside, behind one of its drivers.
#pragma once

#include <atomic>
#include <cstdint>
#include <span>

#include "runtime/core/option.hpp"
#include "runtime/device/heartbeat.hpp"
#include "runtime/unit/component.hpp"
#include "runtime/unit/tick.hpp"

namespace flexrf {

class Device;

enum class DriverKind : std::uint8_t { mock, simulated, real };
const char* name_of(DriverKind kind) noexcept;

/// How the generated application connects a device: its ports, constants, its bus.
struct DeviceBinding : PortBinding {
  std::span<const void* const> resources;  ///< constants, in the order of the interface's table
  Device* bus = nullptr;
};

/// What a device may ask about the run it lives in. Valid from before initialise().
struct DeviceEnvironment {
  std::uint64_t seed = 1;  ///< of this device's random numbers: from --seed and the device's name
  bool virtual_time = false;
  OptionValues options = {};       ///< of the command line; a driver asks its generated base
  Heartbeat* heartbeat = nullptr;  ///< of the application; null: nobody judges, as in virtual time
  Duration longest_step{};  ///< a step that keeps its thread for longer hangs; 0: nobody judges, likewise
};

/// Lives in one thread. receive, send, make_safe and everything a unit calls: that thread, never blocking,
/// never allocating. initialise, stop: the lifecycle thread. Ports are used in that thread alone: each call
/// of receive, send and make_safe is a step to them, and what a unit calls belongs to the unit's step.
class Device : public Component {
 public:
  /// Before the units of the thread step, buses first: take in what arrived. With an IO thread: publish it.
  virtual void receive(const Tick& /*tick*/) noexcept {}
  /// After the units stepped, buses last: send what they commanded.
  virtual void send(const Tick& /*tick*/) noexcept {}
  /// Brings what it moves to its safe state, one non-blocking act per call; true when it is there. It then
  /// stays there while inhibited; after an emergency stop that was cleared, commands of a new Start are
  /// followed without an initialise().
  virtual bool make_safe() noexcept { return true; }

  /// A descriptor that becomes readable when there is something to receive; −1: none. For device triggers.
  virtual int descriptor() const noexcept { return -1; }
  /// When there will be something to receive, of what is not announced by the descriptor: in virtual time
  /// whatever comes, else what the clock alone says; Time::max(): not known to come.
  virtual Time next_event() const noexcept { return Time::max(); }
  /// It is an emergency-stop input: unless it permits, nothing moves. As its configuration says; the
  /// lifecycle thread, also before initialise().
  virtual bool guards_motion() const noexcept { return false; }
  /// Of one that guards motion, after receive(): everything that moves is to be made safe now. What is not
  /// known to be released demands it.
  virtual bool demands_safe_state() const noexcept { return false; }
  /// No more input will ever come (end of file): the application finishes.
  virtual bool is_closed() const noexcept { return false; }

  /// While true an actuator holds or is off, whatever it is commanded. Any thread.
  bool is_inhibited() const noexcept { return inhibited_.load(std::memory_order_acquire); }

  // ---- for the executive; the generated base implements connect()

  /// Also before it is initialised again: its ports begin anew.
  virtual void connect(const DeviceBinding& binding) noexcept = 0;
  void set_environment(const DeviceEnvironment* environment) noexcept { environment_ = environment; }
  void set_inhibited(bool on) noexcept { inhibited_.store(on, std::memory_order_release); }

 protected:
  const DeviceEnvironment& environment() const noexcept { return *environment_; }

 private:
  const DeviceEnvironment* environment_ = nullptr;
  std::atomic<bool> inhibited_{true};
};

/// A driver whose interface is an Actuator (hal/driver/actuator.hpp): it acts only while it may.
template <class Driver>
concept GuardedDriver = requires {
  typename Driver::Guard;
};

}  // namespace flexrf
