// A CiA 401 module with digital inputs and outputs, from the other end of the bus, with faults on purpose.
#pragma once

#include <optional>

#include "base/time.hpp"
#include "hal/canopen/emergency.hpp"
#include "hal/canopen/nmt.hpp"
#include "hal/gpio/chip/canopen/simulator/module_objects.hpp"

namespace flexrf {

/// It speaks CANopen through messages, without I/O, and reads no clock: it is told what time it is, in steps
/// of some milliseconds. One thread. Lines are bits, the first is the lowest.
///
/// Outputs take their error values (objects 6206 and 6207) when it no longer hears its master, or is stopped,
/// and keep them until it is operational again.
class SimulatedCia401Module {
 public:
  struct Options {
    std::uint8_t node = 1;
    std::uint8_t input_bytes = 1;   ///< at most 8
    std::uint8_t output_bytes = 1;  ///< likewise
    Duration boot_delay = std::chrono::milliseconds(20);
  };

  explicit SimulatedCia401Module(const Options& options);

  /// Supply on: it boots.
  void power_on(Time now);
  /// Supply off: it says and does nothing, and forgets; its outputs are off.
  void power_off();

  void receive(const canopen::Message& message, Time now, canopen::Outbox& outbox);
  void advance(Time now, canopen::Outbox& outbox);

  // ---- its terminals

  /// Each change is told at once, as its objects say; also several within one step.
  void drive(std::uint64_t inputs, Time now, canopen::Outbox& outbox);
  std::uint64_t inputs() const { return terminals_; }
  std::uint64_t outputs() const { return outputs_; }

  // ---- faults, on purpose

  /// As when its supply sags: it is off at once and boots again.
  void reset_itself(Time now);
  /// And of its answers to guarding.
  void silence_heartbeat(bool on) { silent_ = on; }
  /// It no longer tells its inputs.
  void silence_inputs(bool on) { tells_no_inputs_ = on; }
  /// It says that something is wrong, which ends with code 0.
  void trip(std::uint16_t error_code, canopen::Outbox& outbox);
  /// It goes to this state by itself.
  void enter(canopen::NmtState state);
  ModuleObjects& objects() { return objects_; }

  canopen::NmtState nmt_state() const { return nmt_; }

 private:
  /// Of the PDO with its inputs.
  struct Sent {
    std::optional<canopen::Message> last{};
    Time at{};
  };

  void boot(Time now, bool all);
  void obey(canopen::NmtCommand command, Time now);
  void answer_guard(const canopen::Message& question, Time now, canopen::Outbox& outbox);
  void hear_master(Duration limit, Time now, canopen::Outbox& outbox);
  void lose_master(canopen::Outbox& outbox);
  void take_outputs(const canopen::Message& message, canopen::Outbox& outbox);
  void put_outputs();
  void read_inputs();
  /// `missing`: of a byte that it has no such object for.
  std::uint64_t lines(canopen::ObjectAddress (*object)(std::uint8_t) noexcept, std::uint8_t bytes,
                      std::uint8_t missing) const;
  void tell_inputs(Time now, canopen::Outbox& outbox);
  void tell_if_due(Time now, canopen::Outbox& outbox);
  void say(std::uint16_t error_code, canopen::Outbox& outbox);

  Options options_;
  ModuleObjects objects_;
  canopen::SdoServer server_;
  bool powered_ = false;
  bool booted_ = false;
  bool silent_ = false;
  bool tells_no_inputs_ = false;
  bool toggle_ = false;  // of its next answer to guarding
  canopen::NmtState nmt_ = canopen::NmtState::boot_up;
  Time boots_at_{};
  Time beats_at_{};
  canopen::HeartbeatConsumer master_;
  bool master_lost_ = false;
  bool in_error_ = false;  // its outputs have their error values
  Sent sent_;
  std::uint64_t terminals_ = 0;
  std::uint64_t outputs_ = 0;
};

}  // namespace flexrf
