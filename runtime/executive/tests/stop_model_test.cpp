// A person's Stop, Clear and Start, a second one who restarts a unit and gives Start, and two threads that
// own actuators: their steps in every interleaving, and twins with one deliberate mistake each, which the
// checker must refuse.
#include <cstdint>

#include "runtime/blackboard/tests/model.hpp"
#include "tests/cmocka.hpp"

namespace flexrf::stop_model_test {
namespace {

using test::assert_holds;
using test::assert_refused;

using Byte = std::uint8_t;

/// Control's word and latch, as a person and the lifecycle thread use them, and the stepper's look at them.
struct Motion {
  enum Mistake : Byte {
    no_mistake,
    start_overwrites,            // it stores the permission, whatever the word is by then
    start_waits_for_nobody,      // whether each owner has had its cycle
    withdraws_before_the_latch,  // so that a Start in between is refused by nothing
    owner_notes_the_newest,      // at the end of a cycle, not what it saw at the beginning
  };
  static constexpr int threads = 4;
  static constexpr Byte owners = 2;
  static constexpr Byte rounds = 2;  // of each person

  explicit Motion(Mistake made) : mistake(made) {}

  bool can_step(int thread) const {
    if (thread < 2) return persons[thread].round < rounds;
    // A cycle begins when there is something to see: what comes by itself would make no other states.
    const Owner& owner = owner_of(thread);
    return owner.at != 0 || owner.seen != withdrawals || owner.noted != withdrawals ||
           owner.moves != may_move();
  }
  const char* step(int thread) {
    if (thread == 0) return stop_clear_start(persons[0]);
    if (thread == 1) return restart_start(persons[1]);
    return cycle(owner_of(thread));
  }
  const char* at_rest() const {
    for (const Owner& owner : own) {
      if (owner.noted != withdrawals) return "a stop was never acted on";
    }
    return nullptr;
  }

 private:
  struct Owner {
    Byte at = 0;
    Byte seen = 0;       // withdrawals, at the look
    Byte moves = 1;      // the look found motion permitted
    Byte noted = 0;      // inhibited_for
    Byte inhibited = 0;  // withdrawals up to which it truly has had a cycle without
  };

  static constexpr int first_of_start = 3;
  struct Person {
    Byte at = 0;
    Byte begun_at = 0;  // withdrawals, as Start found them
    Byte round = 0;
  };

  Owner& owner_of(int thread) { return own[thread - 2]; }
  const Owner& owner_of(int thread) const { return own[thread - 2]; }
  bool may_move() const { return granted && !latched; }
  void withdraw() {
    granted = 0;
    ++withdrawals;
  }

  const char* stop_clear_start(Person& person) {
    switch (person.at) {
      case 0:
        if (mistake == withdraws_before_the_latch) {
          withdraw();
        } else {
          latched = 1;
        }
        break;
      case 1:
        if (mistake == withdraws_before_the_latch) {
          latched = 1;
        } else {
          withdraw();
        }
        break;
      case 2:
        if (latched && granted) return "Clear lets move what was stopped";
        latched = 0;
        break;
      default:
        return start(person);
    }
    ++person.at;
    return nullptr;
  }
  const char* restart_start(Person& person) {
    if (person.at != 0) return start(person);
    withdraw();
    person.at = first_of_start;
    return nullptr;
  }
  const char* start(Person& person) {
    const int place = person.at - first_of_start;
    if (place == 0) {
      person.begun_at = withdrawals;
    } else if (place == 1) {
      if (latched) return end_round(person);
    } else if (place < 2 + owners) {
      if (mistake != start_waits_for_nobody && own[place - 2].noted != person.begun_at)
        return end_round(person);
    } else {
      if (mistake != start_overwrites && withdrawals != person.begun_at) return end_round(person);
      granted = 1;
      if (withdrawals != person.begun_at) return "a Start outlives what withdrew it";
      for (const Owner& owner : own) {
        if (owner.inhibited != withdrawals) return "Start before a thread has acted on the stop";
      }
      return end_round(person);
    }
    ++person.at;
    return nullptr;
  }
  static const char* end_round(Person& person) {
    person.at = 0;
    ++person.round;
    return nullptr;
  }

  const char* cycle(Owner& owner) {
    switch (owner.at) {
      case 0:
        owner.seen = withdrawals;
        owner.at = 1;
        return nullptr;
      case 1:
        owner.moves = may_move() && owner.noted == owner.seen;
        owner.at = 2;
        if (owner.moves && owner.inhibited != owner.seen) return "an actuator never found itself inhibited";
        return nullptr;
      default:
        if (!owner.moves) {
          owner.inhibited = owner.seen;
          owner.noted = mistake == owner_notes_the_newest ? withdrawals : owner.seen;
        }
        owner.at = 0;
        return nullptr;
    }
  }

  Byte mistake;
  Byte granted = 1;  // autostart
  Byte latched = 0;
  Byte withdrawals = 0;
  Person persons[2];
  Owner own[owners];
};

// [stop-8] [stop-9] [stop-94]
void no_stop_is_lost(void**) {
  assert_holds(Motion(Motion::no_mistake));
}

void a_start_that_overwrites_is_found(void**) {
  assert_refused(Motion(Motion::start_overwrites), "a Start outlives what withdrew it");
}

void a_start_that_waits_for_nobody_is_found(void**) {
  assert_refused(Motion(Motion::start_waits_for_nobody), "Start before a thread has acted on the stop");
}

void a_latch_that_comes_too_late_is_found(void**) {
  assert_refused(Motion(Motion::withdraws_before_the_latch), "Clear lets move what was stopped");
}

void an_owner_that_notes_what_it_has_not_acted_on_is_found(void**) {
  assert_refused(Motion(Motion::owner_notes_the_newest), "Start before a thread has acted on the stop");
}

}  // namespace
}  // namespace flexrf::stop_model_test

int main() {
  using namespace flexrf::stop_model_test;
  const CMUnitTest tests[] = {
      cmocka_unit_test(no_stop_is_lost),
      cmocka_unit_test(a_start_that_overwrites_is_found),
      cmocka_unit_test(a_start_that_waits_for_nobody_is_found),
      cmocka_unit_test(a_latch_that_comes_too_late_is_found),
      cmocka_unit_test(an_owner_that_notes_what_it_has_not_acted_on_is_found),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
