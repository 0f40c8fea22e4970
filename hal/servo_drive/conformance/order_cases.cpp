// Whatever happens to an axis, in whatever order: it goes nowhere that nobody has asked for since the last
// Start, and what was said to be safe stays where it is.
#include <algorithm>
#include <array>
#include <optional>

#include "hal/servo_drive/conformance/servo_drive_cases.hpp"
#include "tests/event_orders.hpp"

namespace flexrf::servo_drive_cases {
namespace {

enum class Event : std::uint8_t { stop, start, lost, found, by_hand, command, home, made_safe, idle, count };
constexpr std::array<const char*, events_of<Event>> names{"stop",    "start", "lost",      "found", "by hand",
                                                          "command", "home",  "made safe", "idle"};

constexpr double patience = 0.7;      // s: a drive that was switched on is brought up and enabled in it
constexpr double hand = 0.5;          // how far somebody moves it
constexpr double far = 0.02;          // more than a drive does on its own at rest
constexpr int most_safe_steps = 100;  // until it is safe, or is not going to be

struct Place {
  double low = 0;
  double high = 0;
};

/// A world, and what a person does in it.
class Person {
 public:
  Person(ServoDriveWorld& world, ServoMode mode) : world_{world}, mode_{mode} {
    world_.drive().set_inhibited(true);
    run(patience);
  }

  void does(Event event) {
    switch (event) {
      case Event::stop:
        permit(false);
        rest_unwatched();
        return;
      case Event::start:
        start();
        break;
      case Event::lost:
        world_.lose_drive();
        rest_unwatched();
        return;
      case Event::found:
        world_.find_drive();
        break;
      case Event::by_hand:
        way_ = -way_;
        if (world_.move_by_hand(way_)) {
          where_.reset();
          idle_for(world_, 3 * cycle_seconds);
        }
        break;
      case Event::command:
        is_wanted_ = is_wanted_ || (may_move_ && !is_said_safe_);
        command();
        break;
      case Event::home:
        is_wanted_ = is_wanted_ || (may_move_ && !is_said_safe_);
        do_once(world_, [](ServoDrive& drive) { drive.home(); });
        break;
      case Event::made_safe:
        make_safe();
        return;
      default:
        break;
    }
    run(patience);
  }

  void run(double duration) {
    for (double time = 0; time < duration; time += cycle_seconds) {
      idle_for(world_, cycle_seconds / 2);
      look();
    }
  }

  const char* violation() const { return violation_; }
  int moved_as_asked() const { return moved_as_asked_; }

 private:
  void permit(bool on) {
    may_move_ = on;
    is_wanted_ = false;
    world_.drive().set_inhibited(!on);
  }
  // As the runtime does: the thread has had a cycle without the permission, and what is in fault is
  // initialised before. It may still be braking then, and goes no farther than that takes.
  void start() {
    permit(false);
    idle_for(world_, 3 * cycle_seconds);
    ServoDrive& drive = world_.drive();
    if (!drive.fault().is_ok()) {
      rest_unwatched();
      drive.stop();
      drive.clear_fault();
      if (!drive.initialise().is_ok()) violation_ = "it could not be initialised";
      run(patience);
    }
    where_.reset();
    if (const auto state = drive.state()) {
      const double braking =
          state->velocity * (std::abs(state->velocity) / (2 * acceleration) + 5 * cycle_seconds);
      where_ = {std::min(state->position, state->position + braking),
                std::max(state->position, state->position + braking)};
    }
    permit(true);
    is_said_safe_ = false;
    run(patience);
    if (!is_wanted_) where_.reset();
  }
  void command() {
    target_ = -target_;
    do_for(world_, patience / 2, [this](ServoDrive& drive) {
      if (mode_ == ServoMode::cyclic_position) drive.command_position(target_);
      if (mode_ == ServoMode::cyclic_velocity) drive.command_velocity(target_ / 4);
    });
    if (mode_ == ServoMode::profile_position)
      do_once(world_, [this](ServoDrive& drive) { drive.move_to(target_); });
  }
  void make_safe() {
    is_wanted_ = false;
    for (int i = 0; i < most_safe_steps && !is_said_safe_; ++i) {
      world_.receive(cycle);
      is_said_safe_ = world_.drive().make_safe();
      world_.send();
    }
    where_.reset();
    if (!is_said_safe_) idle_for(world_, patience);
    run(patience);
  }
  // It may come to rest meanwhile.
  void rest_unwatched() {
    idle_for(world_, patience);
    where_.reset();
    run(cycle_seconds);
  }
  void look() {
    const auto state = world_.drive().state();
    if (!state) return;
    if (!where_) where_ = {state->position, state->position};
    if (state->position >= where_->low - far && state->position <= where_->high + far) return;
    if (is_wanted_) {
      ++moved_as_asked_;
    } else if (is_said_safe_) {
      violation_ = "it moved after it had said that it is safe";
    } else {
      violation_ = may_move_ ? "it moved where nobody had asked it to since the last Start"
                             : "it moved without the permission";
    }
  }

  ServoDriveWorld& world_;
  ServoMode mode_;
  std::optional<Place> where_;  // it is to be, unless it was asked to go elsewhere
  bool may_move_ = false;
  bool is_wanted_ = false;
  bool is_said_safe_ = false;
  double way_ = hand;
  double target_ = 3;
  const char* violation_ = nullptr;
  int moved_as_asked_ = 0;
};

}  // namespace

Verdict no_order_of_events_moves_it(MakeServoDriveWorld make, ServoMode mode) {
  const ServoDriveSetup setup{.mode = mode, .needs_home = true};
  if (const auto world = make(setup);
      !world->shares_its_cycle() || !world->lose_drive() || !world->find_drive())
    return Verdict::skipped;
  return verdict(hold_in_orders<Event, 2, 4>(names, 500, 7000, [&](std::span<const Event> order) {
    const auto world = make(setup);
    Person person(*world, mode);
    // It has been led somewhere already.
    for (const Event event : {Event::start, Event::command}) person.does(event);
    for (const Event event : order) person.does(event);
    person.run(patience);
    return OrderOutcome{person.violation(), person.moved_as_asked()};
  }));
}

}  // namespace flexrf::servo_drive_cases
