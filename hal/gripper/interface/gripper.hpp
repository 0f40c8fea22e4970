// Gripper: two fingers that open and close.
#pragma once

#include <limits>
#include <optional>

#include "gripper_interface.hpp"
#include "hal/driver/actuator.hpp"
#include "hal/gripper/interface/gripper_report.hpp"
#include "types/gripper_object.hpp"
#include "types/gripper_safe_state.hpp"

namespace flexrf {

/// What a gripper can do. What it cannot is not pretended: it does not exist in its state, and a command that
/// needs it is refused [gripper-1].
struct GripperCapabilities {
  double open_width = 0;          ///< m between the fingertips when fully open
  double closed_width = 0;        ///< m, when fully closed
  bool positions = false;         ///< goes to any opening; else to fully open and fully closed alone
  bool measures_opening = false;  ///< everywhere; else the opening is known at the two ends alone
  bool speed = false;             ///< of a goal is followed [gripper-11]; else without effect
  bool force = false;             ///< likewise
  bool detects_object = false;    ///< else `object` is never gripped, gripped_inside or lost
  bool halts = false;             ///< the fingers can stop anywhere; else they go on to the end
  // What it can be told, where it can be told one at all.
  double slowest = 0;  ///< m/s
  double fastest = std::numeric_limits<double>::infinity();
  double weakest = 0;  ///< N
  double strongest = std::numeric_limits<double>::infinity();
};

struct GripperGoal {
  double opening = 0;             ///< m between the fingertips; kept within closed_width and open_width
                                  ///< [gripper-2]
  std::optional<double> speed{};  ///< m/s, kept within what it can; nothing: as configured
  std::optional<double> force{};  ///< N, likewise
};

struct GripperState {
  std::optional<double> opening{};  ///< m; nothing: it is not known where the fingers are
  bool activated = false;           ///< it follows commands
  bool moving = false;              ///< from command() or activate() on, until the fingers rest
  GripperObject object = GripperObject::unknown;

  bool holds_object() const noexcept {
    return object == GripperObject::gripped || object == GripperObject::gripped_inside;
  }
};

/// Everything: the thread the gripper lives in. Commands are sent at the end of the cycle; without effect
/// while is_inhibited(), and not remembered: what it was at is ended, and the fingers stay as they
/// are [gripper-3]. By itself it does nothing [gripper-12]. Made safe, it holds what it holds [gripper-13],
/// or opens, as configured [gripper-14], and stays so until it is commanded [gripper-20]. make_safe() is true
/// only while the gripper is heard and its fingers stand; one that is not heard is safe only if it was told
/// nothing since initialise() [gripper-22]. What of a command is kept to a limit or is without effect is told
/// (Component::restrain()) [gripper-15].
class Gripper : public Actuator<GripperInterface> {
 public:
  using Actuator::Actuator;

  /// From initialise() on, always the same.
  virtual GripperCapabilities capabilities() const noexcept = 0;

  /// What it said last, with what was commanded since; nothing while it says nothing [gripper-4].
  virtual std::optional<GripperState> state() const noexcept = 0;
  /// What is wrong, and what a person can do; ok while nothing is. device_fault, unavailable, and timeout:
  /// the fingers did not come to rest in their time [gripper-16], and go on only when they are told
  /// again [gripper-21]. It goes when the cause has gone, what it reports as its own fault with activate()
  /// [gripper-5].
  virtual const Status& trouble() const noexcept = 0;

  /// Makes it follow commands, after power-on and after a fault [gripper-6]: the fingers may go all their way
  /// to both ends, and drop what they hold. Without effect while it is activated and nothing is
  /// wrong [gripper-17], so a unit may call it whenever a person starts it.
  void activate() noexcept {
    if (!may_act()) return;
    was_led_ = true;
    begin_activation();
  }
  /// Towards an opening, gripping what is in the way [gripper-7]. Without effect while it is not
  /// activated [gripper-8]. Replaces the goal before [gripper-18]. Not a finite number, or an opening that it
  /// cannot go to: fault [gripper-9].
  void command(const GripperGoal& goal) noexcept;
  /// Ends the motion where the fingers are [gripper-10], and holds what they hold [gripper-19]; else, as
  /// capabilities() say, at the end.
  virtual void halt() noexcept = 0;

  void open() noexcept { command({.opening = capabilities().open_width}); }
  void close() noexcept { command({.opening = capabilities().closed_width}); }

 protected:
  /// In initialise(), by every driver, with its configuration.
  void begin(const auto& configuration) noexcept {
    safe_state_ = configuration.safe_state;
    releasing_ = was_led_ = false;
    report_.reset();
  }

 private:
  /// In receive(): what arrived.
  virtual void hear(const Tick& tick) noexcept = 0;
  /// A command that is taken.
  virtual void begin_activation() noexcept = 0;
  /// Likewise: a goal within what it can. Without effect unless is_ready().
  virtual void go(const GripperGoal& goal) noexcept = 0;
  /// It is heard and activated: a goal is followed.
  virtual bool is_ready() const noexcept = 0;
  /// As it was heard last: nothing is under way, and it has what it was told. Asked only while it is heard.
  virtual bool is_at_rest() const noexcept = 0;
  /// The end of the cycle. `safe`: it may not act.
  virtual void tell(const Tick& tick, bool safe) noexcept = 0;

  void take_in(const Tick& tick) noexcept final;
  // To release is under way, or done, on account of make_safe(): only what it was commanded is given up.
  void forget() noexcept final {
    if (!releasing_) halt();
  }
  void act(const Tick& tick) noexcept final {
    releasing_ = false;
    tell(tick, false);
  }
  void rest(const Tick& tick) noexcept final { tell(tick, true); }
  bool become_safe() noexcept final;

  GripperReport report_;
  GripperSafeState safe_state_ = GripperSafeState::hold;
  bool releasing_ = false;  // until it may act again
  bool was_led_ = false;    // since initialise()
};

}  // namespace flexrf
