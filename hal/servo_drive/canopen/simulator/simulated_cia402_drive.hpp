// A CiA 402 drive with one axis, from the other end of the bus, with faults on purpose.
#pragma once

#include "base/time.hpp"
#include "hal/canopen/cia402.hpp"
#include "hal/canopen/emergency.hpp"
#include "hal/canopen/nmt.hpp"
#include "hal/servo_drive/canopen/simulator/drive_motion.hpp"
#include "hal/servo_drive/canopen/simulator/drive_objects.hpp"

namespace flexrf {

/// It speaks CANopen through messages, without I/O, and reads no clock: it is told what time it is, in steps
/// of at most some milliseconds while it moves. One thread.
class SimulatedCia402Drive {
 public:
  struct Options {
    std::uint8_t node = 1;
    Duration boot_delay = std::chrono::milliseconds(20);
    Duration brake_delay = std::chrono::milliseconds(50);  ///< from switched on to enabled
    double fastest = 50000;                                ///< increments/s, of the motor
    double first_position = 1000;                          ///< increments
    /// Acts on each object of a PDO as it is written, as some drives do: on a controlword before the target
    /// that stands behind it. Else when all of the PDO is taken.
    bool acts_on_each_object = false;
  };

  explicit SimulatedCia402Drive(const Options& options);

  /// Supply on: it boots.
  void power_on(Time now);
  /// Supply off: it says and does nothing, and forgets.
  void power_off();

  void receive(const canopen::Message& message, Time now, canopen::Outbox& outbox);
  void advance(Time now, canopen::Outbox& outbox);

  // ---- faults, on purpose

  /// As when its supply sags: it is off at once and boots again.
  void reset_itself(Time now);
  /// And of its answers to guarding.
  void silence_heartbeat(bool on) { silent_ = on; }
  /// Commands no longer lead out of this state; nothing: they do.
  void stick_in(std::optional<canopen::cia402::DriveState> state) { stuck_ = state; }
  /// Goes into fault with this error code. While `persists`, resetting the fault does not help.
  void trip(std::uint16_t error_code, bool persists, canopen::Outbox& outbox);
  /// It keeps the mode that it is in.
  void ignore_mode(bool on) { ignores_mode_ = on; }
  /// It stays where it is in the cyclic modes, and says so.
  void ignore_set_points(bool on) { ignores_set_points_ = on; }
  /// It finds no home.
  void lose_home(bool on) { homeless_ = on; }
  void heal() { cause_persists_ = false; }
  /// What the axis meets, in increments: it gets no lower than `below`, and no higher than `above`, and
  /// presses against it with its greatest torque. Nothing: there is nothing.
  void block(std::optional<double> below, std::optional<double> above) {
    below_ = below;
    above_ = above;
  }
  /// The wires of its motor are torn: it has no torque, and stays where it is.
  void cut_motor(bool on) { is_cut_ = on; }
  /// Somebody moves its axis by so many increments, which it resists while it has torque.
  void be_moved(double increments) {
    if (!powered_ || !canopen::cia402::has_torque(state_)) motion_.stop_at(motion_.position() + increments);
  }
  DriveObjects& objects() { return objects_; }

  // ---- what it is doing

  canopen::NmtState nmt_state() const { return nmt_; }
  canopen::cia402::DriveState state() const { return state_; }
  const DriveMotion& motion() const { return motion_; }
  /// SYNCs that it acted on.
  std::uint64_t synchronised() const { return synchronised_; }
  /// Of those in operation enabled: before which a PDO that waits for SYNC had not come.
  std::uint64_t missed() const { return missed_; }
  /// The farthest that a cyclic target ever was from the axis, in increments.
  double longest_jump() const { return longest_jump_; }
  /// How often a set-point was taken in mode profile_position.
  std::uint64_t set_points() const { return set_points_; }
  /// Of the last one: where to, increments, and how fast, increments/s.
  double set_point() const { return profile_target_; }
  double set_point_speed() const { return profile_speed_; }

 private:
  /// What is wrong in it, as its error register and its emergencies tell.
  enum class Error : std::uint8_t { fault = 1, heartbeat = 2, short_pdo = 4 };

  /// Of a PDO that it sends.
  struct Sent {
    std::optional<canopen::Message> last{};
    Time at{};
    unsigned syncs = 0;  // since it was sent
  };

  void boot(Time now, bool all);
  void obey(canopen::NmtCommand command, Time now);
  void answer_guard(const canopen::Message& question, Time now, canopen::Outbox& outbox);
  void take_pdo(const canopen::Message& message, Time now, canopen::Outbox& outbox);
  void synchronise(Time now, canopen::Outbox& outbox);
  void apply(const canopen::PdoPlan& plan, const canopen::Message& message, Time now,
             canopen::Outbox& outbox);
  canopen::Message pdo_now(const canopen::PdoPlan& plan) const;
  void send_at_sync(Time now, canopen::Outbox& outbox);
  void send_by_events(Time now, canopen::Outbox& outbox);
  bool is_led_by_positions() const;
  bool interpolates() const;
  double cyclic_target() const;
  void take_cyclic_target();
  double place_of(std::int64_t target) const;
  void supervise(Time now, canopen::Outbox& outbox);
  void raise(Error error, std::uint16_t code, canopen::Outbox& outbox);
  void end(Error error, canopen::Outbox& outbox);
  void show_errors();
  void emit(std::uint16_t error_code, canopen::Outbox& outbox);

  void command(Time now, canopen::Outbox& outbox);
  void enter(canopen::cia402::DriveState state, Time now);
  void move(Time now, canopen::Outbox& outbox);
  void take_mode();
  void meet_obstacles();
  void find_home(bool started, double acceleration, double time);
  void move_in_mode(double time, canopen::Outbox& outbox);
  void follow_cyclic_target(double time, canopen::Outbox& outbox);
  void stay(double acceleration, double time);
  void publish();

  Options options_;
  DriveObjects objects_;
  canopen::SdoServer server_;
  DriveMotion motion_;
  bool powered_ = false;
  bool booted_ = false;
  bool silent_ = false;
  canopen::NmtState nmt_ = canopen::NmtState::boot_up;
  Time boots_at_{};
  Time beats_at_{};
  canopen::HeartbeatConsumer master_;
  bool master_lost_ = false;
  bool toggle_ = false;  // of its next answer to guarding
  std::uint8_t errors_ = 0;
  std::array<Sent, DriveObjects::pdos> sent_{};
  bool was_homed_ = false;
  std::array<std::optional<canopen::Message>, 2> pending_;  // synchronous RPDOs wait for SYNC

  canopen::cia402::DriveState state_ = canopen::cia402::DriveState::not_ready;
  std::optional<canopen::cia402::DriveState> stuck_;
  bool cause_persists_ = false;
  bool ignores_mode_ = false;
  bool ignores_set_points_ = false;
  bool homeless_ = false;
  bool is_cut_ = false;
  std::optional<double> below_;
  std::optional<double> above_;
  int presses_ = 0;  // towards lower or higher positions
  std::uint16_t last_command_ = 0;
  Time entered_{};
  Time moved_{};
  std::uint16_t mode_bits_ = 0;
  bool targets_fresh_ = false;  // a target came since it was enabled
  double cyclic_speed_ = 0;     // increments/s that the last cyclic target asks for
  double profile_target_ = 0;
  double profile_speed_ = 0;  // increments/s that came with it
  std::uint64_t set_points_ = 0;
  double longest_jump_ = 0;
  std::uint64_t synchronised_ = 0;
  std::uint64_t missed_ = 0;
};

}  // namespace flexrf
