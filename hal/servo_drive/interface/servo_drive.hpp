// ServoDrive: a drive with one axis that follows positions or velocities, and finds its home.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "hal/driver/actuator.hpp"
#include "hal/servo_drive/interface/profile_progress.hpp"
#include "hal/servo_drive/interface/velocity_lag.hpp"
#include "servo_drive_interface.hpp"
#include "types/servo_homing.hpp"
#include "types/servo_mode.hpp"

namespace flexrf {

/// Positions in rad of a rotary axis, in m of a linear one; velocities a second of it.
struct ServoState {
  double position = 0;
  double velocity = 0;
  double following_error = 0;  ///< cyclic set-point less position; 0 in other modes than cyclic_position
                               ///< [servo-drive-25]
  bool enabled = false;        ///< it follows; else it is off, or on its way to either
  bool at_internal_limit = false;
  /// In profile modes: the drive took the last command and has done it [servo-drive-1]. False from the
  /// command on, after a halt, while it homes, and in cyclic modes [servo-drive-26].
  bool target_reached = false;
  ServoHoming homing = ServoHoming::not_homed;
  /// When the drive told the position, on the clock of the cycles: at most now. It stands still while the
  /// drive tells nothing new.
  Time measured_at{};
};

/// Everything: the thread the drive lives in. With the permission to move, the drive enables itself, with its
/// set-point where it is [servo-drive-2]; that takes as long as the drive takes. Without it, it stops and is
/// off [servo-drive-3]. Made safe, it comes to rest, is off and stays where it is [servo-drive-20]. One that
/// trips is in fault, and says why [servo-drive-21].
///
/// configuration.mode says which of the commands it takes. The others are without effect, as are all of them
/// while the drive is not enabled or is homing; none of those is remembered [servo-drive-4]. What is kept to
/// a limit or is without effect for another reason than these two is told
/// (Component::restrain()) [servo-drive-5]. What is not finite, or a speed that is not above 0, puts the
/// drive in fault [servo-drive-6].
class ServoDrive : public Actuator<ServoDriveInterface> {
 public:
  using Actuator::Actuator;

  /// The speed of move_to() that is the greatest of the configuration.
  static constexpr double full_speed = std::numeric_limits<double>::max();

  /// What the drive said last, as of this cycle, with what was commanded since; nothing while it says
  /// nothing [servo-drive-7].
  virtual std::optional<ServoState> state() const noexcept = 0;

  /// In mode cyclic_position: where the axis shall be, sent at the end of the cycle and held until the next
  /// command [servo-drive-8]. Kept to the range and the velocity of the configuration [servo-drive-9], and to
  /// its acceleration: what moves within these is met exactly, what jumps is approached and not
  /// passed [servo-drive-27]. An endless axis has no range, and with a modulo goes the shorter way from the
  /// command before [servo-drive-10].
  void command_position(double position) noexcept {
    if (may_act()) follow_position(position);
  }
  /// In mode cyclic_velocity or profile_velocity: how fast it shall be, kept to the velocity of the
  /// configuration, and to that with which the axis comes to rest at the end of its range, by the
  /// configuration's acceleration, unless it is endless [servo-drive-11].
  void command_velocity(double velocity) noexcept {
    if (may_act()) follow_velocity(velocity);
  }
  /// In mode profile_position: where it shall go, once for each target and not in each cycle; kept to the
  /// range; an endless axis has none, and with a modulo goes the shorter way from where it is. It gives up
  /// the target before [servo-drive-12]. `speed`: above 0, kept to the velocity of the
  /// configuration [servo-drive-13].
  void move_to(double position, double speed = full_speed) noexcept {
    if (may_act()) begin_move(position, speed);
  }

  /// Begins to find its home with the configured method, whatever the mode; homing is `running` from this
  /// call on, then `homed` or `failed` [servo-drive-14]. When it is over the drive is in its mode again and
  /// holds [servo-drive-15]. Without effect while it is not enabled [servo-drive-22]
  /// or is homing, and with method 0 [servo-drive-23].
  void home() noexcept {
    if (may_act()) begin_homing();
  }
  /// Why homing is `failed`; else ok [servo-drive-16].
  virtual const Status& homing_problem() const noexcept = 0;

  /// Comes to rest with the configured acceleration and holds, enabled, until the next command; what was
  /// commanded is given up [servo-drive-17]. A homing has failed then [servo-drive-18].
  virtual void halt() noexcept = 0;

 protected:
  /// At the end of receive(), by every driver: an axis that does not follow its set-points, does not go as
  /// fast as it is told, or does not come nearer to its target, is in fault [servo-drive-19]; one that only
  /// takes its time, or turns for long, is not [servo-drive-24]. `configuration`: the driver's. `asked`: the
  /// velocity that the drive is told, unit/s; 0 in other modes than those that are led by velocities.
  /// `target`: of a drive that is on its way to one with its own profile; else nothing.
  void supervise(const auto& configuration, double asked, const std::optional<ProfileTarget>& target,
                 Time now) noexcept {
    const auto told = state();
    if (!told || !told->enabled || !may_act() || configuration.following_time == 0) {
      lag_.forget();
      progress_.forget();
      return;
    }
    const double most = configuration.following_time * configuration.fastest;
    supervise_profile(configuration, most, target, now);
    // A drive that is led by cyclic velocities is told no acceleration, and has its own limits.
    const double patient = configuration.acceleration / 2;
    const double slow = lag_.look(asked, patient, told->position, 2 * most,
                                  configuration.endless ? configuration.modulo : 0, now);
    const double behind = std::max(std::abs(told->following_error), slow);
    if (behind <= most || !fault().is_ok()) return;
    set_fault(Status::error(
        StatusCode::device_fault,
        "its axis is %.4g behind, more than it moves in `following_time` (%g s): does it stick, or does its "
        "encoder?",
        behind, configuration.following_time));
  }

 private:
  // What a driver does with a command that is taken; as the function of the command says.
  virtual void follow_position(double position) noexcept = 0;
  virtual void follow_velocity(double velocity) noexcept = 0;
  virtual void begin_move(double position, double speed) noexcept = 0;
  virtual void begin_homing() noexcept = 0;

  void supervise_profile(const auto& configuration, double most, const std::optional<ProfileTarget>& target,
                         Time now) noexcept {
    // A drive may need some time to begin, and the time of its ramps to turn round before that.
    const double ramps = 2 * configuration.fastest / configuration.acceleration;
    const double patience = 4 * configuration.following_time + ramps;
    constexpr double all_but_there = 0.04;
    const auto away = progress_.look(target, patience, all_but_there * most, now);
    if (!away) return;
    set_fault(Status::error(
        StatusCode::device_fault,
        "its axis is %.4g from its target and has not come nearer in %.3g s (four times `following_time` and "
        "its ramps) by a tenth of what its speed makes: %s",
        *away, patience, target->says[0] == '\0' ? "does it stick, or does its encoder?" : target->says));
  }

  VelocityLag lag_;
  ProfileProgress progress_;
};

}  // namespace flexrf
