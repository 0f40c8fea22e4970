// Whatever happens to a gripper, in whatever order: its fingers go nowhere that nobody has asked for since
// the last Start, and what was said to be safe stays where it is.
#include <array>
#include <span>

#include "hal/gripper/conformance/gripper_cases.hpp"
#include "tests/event_orders.hpp"

namespace flexrf::gripper_cases {
namespace {

enum class Happening : std::uint8_t {
  stop,
  start,
  silent,
  off,
  unplugged,
  tripped,
  well,
  command,
  activate,
  made_safe,
  idle,
  count
};
constexpr std::array<const char*, events_of<Happening>> names{"stop",      "start",     "silent", "off",
                                                              "unplugged", "tripped",   "well",   "command",
                                                              "activate",  "made safe", "idle"};

constexpr Duration travel = std::chrono::milliseconds(900);  // more than the fingers take for all their way
constexpr int most_safe_steps = 100;                         // until it is safe, or is not going to be

/// A world, and what a person does in it.
class Operator {
 public:
  explicit Operator(GripperWorld& world) : world_{world} { static_cast<void>(starts_active(world)); }

  void does(Happening happening) {
    switch (happening) {
      case Happening::stop:
        permit(false);
        break;
      case Happening::start:
        permit(false);
        idle_for(world_, Duration{});
        permit(true);
        break;
      case Happening::silent:
        world_.make(GripperFarEnd::silent);
        break;
      case Happening::off:
        world_.make(GripperFarEnd::off);
        break;
      case Happening::unplugged:
        world_.make(GripperFarEnd::unplugged);
        break;
      case Happening::tripped:
        world_.make(GripperFarEnd::tripped);
        break;
      case Happening::well:
        watch(travel);  // what it was doing it has done
        world_.make(GripperFarEnd::well);
        watch(travel);
        return;
      case Happening::command:
        opens_ = !opens_;
        is_wanted_ = is_wanted_ || (may_move_ && !is_said_safe_);
        act(world_, [this](Gripper& gripper) { gripper.command({.opening = opens_ ? opened : closed}); });
        break;
      case Happening::activate:
        is_wanted_ = is_wanted_ || (may_move_ && !is_said_safe_);
        act(world_, [](Gripper& gripper) { gripper.activate(); });
        break;
      case Happening::made_safe:
        make_safe();
        break;
      default:
        watch(travel);
        return;
    }
    // Its fingers end what they were at, if they cannot be halted or no longer hear it.
    idle_for(world_, travel);
    if (is_wanted_ && !near(world_.fingers(), where_)) ++moved_as_asked_;
    where_ = world_.fingers();
    watch(travel / 4);
  }

  const char* violation() const { return violation_; }
  int moved_as_asked() const { return moved_as_asked_; }

 private:
  void permit(bool on) {
    may_move_ = on;
    is_wanted_ = is_said_safe_ = false;
    world_.gripper().set_inhibited(!on);
  }
  void make_safe() {
    is_wanted_ = false;
    for (int i = 0; i < most_safe_steps && !is_said_safe_; ++i) {
      world_.receive();
      is_said_safe_ = world_.gripper().make_safe();
      world_.send();
    }
    if (!is_said_safe_) return;
    where_ = world_.fingers();
    watch(travel);
  }
  void watch(Duration duration) {
    for (const Time begin = world_.now(); world_.now() - begin < duration;) {
      world_.receive();
      world_.send();
      if (is_wanted_ || near(world_.fingers(), where_)) continue;
      violation_ = is_said_safe_ ? "it moved after it had said that it is safe"
                                 : "it moved where nobody had asked it to since the last Start";
    }
  }

  GripperWorld& world_;
  double where_ = opened;
  bool may_move_ = true;
  bool is_wanted_ = false;
  bool is_said_safe_ = false;
  bool opens_ = true;
  const char* violation_ = nullptr;
  int moved_as_asked_ = 0;
};

}  // namespace

Verdict no_order_of_events_moves_it(MakeGripperWorld make) {
  if (!make()->has_virtual_time()) return Verdict::skipped;
  return verdict(hold_in_orders<Happening, 2, 4>(names, 500, 10'000, [&](std::span<const Happening> order) {
    const auto world = make();
    Operator person(*world);
    // Stopped in the middle of its way, and left there.
    person.does(Happening::command);
    for (const Happening happening : order) person.does(happening);
    person.does(Happening::idle);
    return OrderOutcome{person.violation(), person.moved_as_asked()};
  }));
}

}  // namespace flexrf::gripper_cases
