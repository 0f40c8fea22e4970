// An axis of a CiA 402 drive as a driver uses it: brought up, enabled, homed, fed with set-points, and
// stopped.
#pragma once

#include <limits>
#include <utility>

#include "hal/canopen/axis_homing.hpp"
#include "hal/canopen/drive_modes.hpp"
#include "hal/canopen/drive_power.hpp"
#include "hal/canopen/node.hpp"
#include "hal/canopen/position_velocity.hpp"
#include "hal/canopen/sdo_stop.hpp"
#include "hal/canopen/unmapped_objects.hpp"
#include "hal/servo_drive/interface/profile_progress.hpp"
#include "motion/set_point_follower.hpp"
#include "runtime/unit/restraint.hpp"

namespace flexrf::canopen::cia402 {

/// "Unit": rad of a rotary axis, m of a linear one.
struct AxisPlan {
  std::uint8_t node = 1;
  std::uint8_t master = 127;
  std::uint32_t vendor = 0;                        ///< 0: any
  std::uint32_t product = 0;                       ///< 0: any
  Mode mode = Mode::cyclic_position;               ///< not homing: see home()
  Duration period = std::chrono::milliseconds(7);  ///< of SYNC and set-points; whole ms, at most 255
  double increments_per_unit = 1000;               ///< negative: it turns the other way; not 0
  double lowest = -1000;                           ///< position, unit
  double highest = 1000;                           ///< position, unit
  bool endless = false;      ///< it has no end: neither of them counts; its drive's counter runs over
  double modulo = 0;         ///< of an endless one, unit: told from 0 up to this; 0: counted on
  double fastest = 1;        ///< unit/s, above 0
  double acceleration = 10;  ///< unit/s^2, above 0: of profiles, of cyclic positions, and of a halt
  double quick_stop_deceleration = 0;  ///< unit/s^2; 0: as the drive has it
  std::int16_t quick_stop_option = 0;  ///< object 605A; 0: as the drive has it
  /// The drive's units of velocity for one increment/s, and of acceleration for one increment/s^2; above 0.
  double velocity_factor = 1;
  double acceleration_factor = 1;
  std::int8_t homing_method = 0;     ///< object 6098; 0: its encoder is absolute
  double homing_speed = 0.1;         ///< unit/s, above 0
  double homing_creep_speed = 0.02;  ///< unit/s, above 0
  double rest_velocity = 0.001;      ///< unit/s: at most so fast is at rest
  /// Object 6007, what it does without our heartbeat, and last_word(): 0 goes on, 1 fault, 2 off, 3 quick
  /// stop.
  std::int16_t abort_connection = 3;
  // What not every drive has, or takes.
  bool tells_abort_connection = true;  ///< object 6007
  bool tells_period = true;            ///< object 60C2
  bool is_supervised_by_it = true;     ///< object 1016: it looks for our heartbeat
  bool forbids_remote = true;          ///< bit 30 of the identifiers of what it sends
  bool is_guarded = false;             ///< it has no heartbeat, see NodePlan
  bool changes_mode_enabled = true;    ///< else it is switched off for that, before and after a homing
  /// Controlword bit 5: it takes another target on its way to one. Else each waits until it is at the one
  /// before, and it is switched off and on after a halt, so that it forgets where it was going.
  bool changes_target_at_once = true;
  bool maps_mode = true;      ///< objects 6060 and 6061 in its PDOs; else see UnmappedObjects
  bool maps_speed = true;     ///< object 6081 in a PDO; else likewise
  bool maps_velocity = true;  ///< object 606C in a PDO; else its velocity is that of its positions
  bool tells_speed = true;    ///< object 6081; else each profile is as fast as the drive's own
  // Of an axis that may meet something, as a gripper's does.
  bool limits_torque = false;   ///< object 6072, see limit_torque(); in mode profile_position only
  bool tells_torque = false;    ///< object 6077
  bool may_be_blocked = false;  ///< object 6065: however far it is behind its profile is no fault
  Duration mode_timeout = std::chrono::milliseconds(500);
  Duration set_point_timeout = std::chrono::milliseconds(500);  ///< until it acknowledges one
  Duration homing_timeout = std::chrono::seconds(60);
  Duration homing_settle = std::chrono::milliseconds(50);  ///< see HomingRun
  bool homing_tells_reached = true;                        ///< likewise
  Duration boot_timeout = std::chrono::seconds(1);
  Duration sdo_timeout = std::chrono::milliseconds(500);
  Duration heartbeat_period = std::chrono::milliseconds(100);
  Duration heartbeat_limit = std::chrono::milliseconds(250);
  DrivePower::Limits limits;
};

struct AxisState {
  double position = 0;         ///< unit
  double velocity = 0;         ///< unit/s
  double following_error = 0;  ///< the last set-point less position, unit; 0 in other modes
  bool enabled = false;
  bool at_internal_limit = false;
  /// In profile modes: the drive took the last command and says that it has done it. Of a position, the axis
  /// is also within what it moves in a period, or it has stood for some cycles within the drive's own window
  /// (object 6067).
  bool target_reached = false;
  double torque = 0;  ///< of its rated torque, with a sign; 0 where the plan does not ask for it
};

/// Without I/O; never blocks, never allocates. One thread. A cycle: receive() of what came, then commands,
/// then send(). A fault stays until begin(): nothing is enabled again by itself.
class ServoAxis {
 public:
  /// A speed of move_to(): as fast as the plan says.
  static constexpr double full_speed = std::numeric_limits<double>::max();

  /// Error: the plan makes no sense.
  Status begin(const AxisPlan& plan, Time now, Outbox& outbox) noexcept;
  /// The drive is to be off already; the node leaves its operation.
  void end(Outbox& outbox) noexcept;

  void receive(const Message& message, Time now, Outbox& outbox) noexcept;
  /// The end of the cycle, `elapsed` after the one before: set-points, SYNC, heartbeat. `may_move` false: it
  /// is stopped and off, and forgets what it was commanded.
  void send(bool may_move, Time now, Duration elapsed, Outbox& outbox) noexcept;

  // What follows is without effect in other modes, while the axis is not enabled, and while it homes, and is
  // not remembered. What is not finite is a fault.

  /// In modes cyclic_position and interpolated_position: unit, kept within lowest and highest; with a modulo
  /// by the shorter way from the one before. Held until the next one. Set-points go there as fast as it moves
  /// itself, within fastest and acceleration.
  void command_position(double position) noexcept;
  /// In modes cyclic_velocity and profile_velocity: unit/s, kept within fastest, and slowed down with the
  /// plan's acceleration so that the axis comes to rest at the end of its range.
  void command_velocity(double velocity) noexcept;
  /// In mode profile_position: unit, kept within lowest and highest, and unit/s, above 0, kept within
  /// fastest; with a modulo by the shorter way from where it is. Gives up the target before.
  void move_to(double position, double speed) noexcept;
  /// In every mode, unless the plan's method is 0.
  void home() noexcept;
  /// Where the plan says so, also while it is off: at most so much of its rated torque; at first 1.
  void limit_torque(double share) noexcept { most_torque_ = share; }
  /// In every mode, also while it homes: to rest, until the next command.
  void halt() noexcept;

  Homing homing() const noexcept { return homing_.state(); }
  const Status& homing_problem() const noexcept { return homing_.problem(); }

  /// What the drive said last; nothing while it is not operational or says nothing.
  const std::optional<AxisState>& state() const noexcept { return state_; }
  /// While there is a state(): when its position arrived.
  Time heard_at() const noexcept { return heard_; }
  /// It follows commands; in mode interpolated_position that takes some cycles more than its state machine. A
  /// drive that has to forget its target after a halt follows none until it was off.
  bool is_enabled() const noexcept {
    return power_.is_enabled() && !drops_target_ &&
           (plan_.mode != Mode::interpolated_position || interpolation_.was_active());
  }
  /// The drive was not enabled since begin(), or its last off_cycles statuswords said that it has no torque.
  /// A drive that is not heard is not off.
  bool is_off() const noexcept { return !may_have_torque_; }
  /// What stopped it, for a person; ok while nothing did.
  const Status& fault() const noexcept { return fault_; }
  /// What it is told when this process dies; nothing while it is not heard, or where plan.abort_connection
  /// says that it goes on. SYNC has to follow: its PDOs are synchronous.
  ///
  /// What the drive does at last without our heartbeat (object 6007), only at once: the process data that it
  /// was told last, set-point and mode included, so that nothing but its state changes, with the controlword
  /// quick stop (transition 11 of CiA 402), or disable voltage (9) where 6007 says so. Disabled, or in fault,
  /// it stays so: neither word leads to torque from any state. Process data, because their mapping is known,
  /// configured or read back, and they act at the SYNC behind them. An SDO would have to wait for the answer
  /// to one under way, and a drive may refuse it for an object that is in a PDO; NMT stop takes everybody on
  /// the bus out of operation, of a drive asks no more than 6007 says, if it has that, and makes it deaf to
  /// process data.
  std::optional<Message> last_word() const noexcept;
  /// After a send() without the permission to move: what stopped it is forgotten, and with the permission it
  /// is enabled anew. A node that was refused stays so.
  void forget_fault() noexcept { fault_ = {}; }
  const Node& node() const noexcept { return node_; }
  /// Objects 6041 and 6061 as the drive told them last, since begin().
  std::uint16_t statusword() const noexcept { return statusword_; }
  Mode mode_shown() const noexcept { return mode_shown_; }
  /// What the drive is told in the modes that are led by velocities, unit/s; else 0.
  double asked_velocity() const noexcept { return asked_velocity_; }
  /// In the modes with a profile: the drive has no object for an acceleration (6083) and was told none.
  bool has_own_ramps() const noexcept { return node_.has_left_out(objects::profile_acceleration); }
  /// It was not told an option of its quick stop (object 605A), and says that it only goes off.
  bool quick_stop_coasts() const noexcept { return node_.answered(objects::quick_stop_option) == 0U; }
  /// In mode profile_position, what the drive took and is not at yet; else nothing.
  std::optional<ProfileTarget> profile_target() const noexcept;
  bool is_restrained() const noexcept { return restraint_.reason != nullptr; }
  /// Why it does less than it was commanded, in this cycle and as long as that command stands; once.
  Restraint take_restraint() noexcept { return std::exchange(restraint_, Restraint{}); }

 private:
  static constexpr int silent_cycles = 10;    // without process data it is not known where it is
  static constexpr int ignoring_cycles = 10;  // with set-points that it says it ignores, before that is told
  static constexpr int off_cycles = 3;  // without torque: what came first may be from before it was told
  static constexpr int standing_cycles = 10;  // within the drive's own window, before that counts as reached
  static constexpr int settle_cycles = 5;  // from a velocity that is commanded to a status that is about it

  Status check(const AxisPlan& plan) const noexcept;
  NodePlan node_plan() noexcept;
  void plan_motion(Configuration& list) const noexcept;
  void fail(const Status& cause) noexcept;
  void watch(bool may_move, Time now) noexcept;
  bool take_process_data(const Message& message, Time now) noexcept;
  void note_torque() noexcept;
  bool hears_of_velocity(Time now) const noexcept;
  bool is_at_rest(Time now) const noexcept;
  bool is_told_by_sdo() const noexcept;
  bool is_outpaced() const noexcept;
  std::uint32_t speed_object() const noexcept { return to_amount(to_velocity_object(handshake_.speed())); }
  void settle_unmapped(Time now, Outbox& outbox) noexcept;
  void stop_unheard(Time now, Outbox& outbox) noexcept;
  void watch_following() noexcept;
  bool mode_is_taken(bool wanted, Time now) noexcept;
  bool is_led_in(Mode one, Mode other) const noexcept { return plan_.mode == one || plan_.mode == other; }
  bool takes(Mode one, Mode other) noexcept;
  bool may_be_commanded() const noexcept;
  double permitted_velocity() const noexcept;
  bool is_number(double value, const char* what) noexcept;
  double by_the_shorter_way(double position, double from) const noexcept;
  double in_reach(double way) noexcept;
  double position_of(std::int32_t increments) noexcept;
  void take_motion(const std::uint64_t* values, Time now) noexcept;
  double told(double way) const noexcept;
  void tell_restraint() noexcept;
  double within(double value, double lowest, double highest, const char* reason) noexcept;
  void seed() noexcept;
  std::uint16_t mode_bits(bool at_rest, Time now) noexcept;
  double target_for(Duration elapsed) noexcept;
  double velocity_for(Duration elapsed) noexcept;
  double beside_target() const noexcept;
  double own_window() const noexcept;
  const char* why_target_is_not_reached() const noexcept;
  bool has_reached(std::uint16_t statusword) const noexcept;
  Message process_data(std::uint16_t word) const noexcept;
  void say(std::uint16_t word, Outbox& outbox) const noexcept;

  /// A speed or an acceleration as the drive counts it; at least 1, or it would never move.
  static std::uint32_t to_amount(double value) noexcept;
  double to_velocity_object(double velocity) const noexcept {
    return velocity * plan_.increments_per_unit * plan_.velocity_factor;
  }

  AxisPlan plan_;
  Node node_;
  DrivePower power_;
  SetPointFollower cyclic_;  // the drive follows without a profile of its own: none may jump
  SetPointHandshake handshake_{std::chrono::milliseconds(500)};
  InterpolationSwitch interpolation_{std::chrono::milliseconds(500)};
  AxisHoming homing_;
  UnmappedObjects unmapped_;
  SdoStop sdo_stop_;
  PdoPlan commands_;
  PdoPlan profile_;  // in mode profile_position; may be empty
  PdoPlan states_;
  PdoPlan motion_;
  HeartbeatProducer beat_;
  std::optional<AxisState> state_;
  PositionVelocity from_positions_;
  Status fault_;
  Time heard_{};
  Time velocity_heard_{};
  double position_velocity_ = 0;  // as its positions tell it
  bool may_have_torque_ = false;
  int stood_ = 0;      // cycles at rest in which the drive said that it is there, at most standing_cycles
  int off_heard_ = 0;  // one after the other, at most off_cycles
  bool heard_now_ = false;  // since the last send()
  std::optional<Time> mode_wanted_;
  bool is_off_for_mode_ = false;  // on its way off, into another mode and on again, for a homing
  bool drops_target_ = false;     // halted, and on its way off and on again, so that it forgets where it went
  std::uint16_t statusword_ = 0;
  Mode mode_shown_ = Mode::none;
  Mode mode_said_ = Mode::none;
  bool was_operational_ = false;
  std::uint64_t bring_ups_ = 0;
  bool was_commanded_ = false;       // since it was enabled, homed or halted
  bool halts_ = false;               // until the next command, in profile_position until it is handed over
  int ignored_ = 0;                  // set-points, one after the other, at most ignoring_cycles
  int cycles_ = 0;                   // since the velocity was commanded, at most settle_cycles
  double velocity_ = 0;              // commanded
  double asked_velocity_ = 0;        // of the drive
  double most_torque_ = 1;           // of its rated torque
  std::uint64_t target_object_ = 0;  // as it was sent
  std::optional<std::int32_t> counted_;  // of an endless axis: what the drive said last
  std::int64_t count_ = 0;               // increments, beyond what the drive's counter holds
  double way_ = 0;                       // the same, unit: the position but for its modulo
  Restraint restraint_;                  // of this cycle
  Restraint held_;                       // of the command that stands
};

}  // namespace flexrf::canopen::cia402
