// All orders in which some events can come, and more at random: for rules that have to hold whatever comes
// first.
#pragma once

#include <array>
#include <cstddef>
#include <cstdio>
#include <random>
#include <span>
#include <string>

#include "tests/test_extent.hpp"

namespace flexrf {

/// `Event`: an enumeration that begins at 0 and ends with `count`.
template <class Event>
inline constexpr std::size_t events_of = static_cast<std::size_t>(Event::count);

/// What one order came to.
struct OrderOutcome {
  const char* violation = nullptr;  ///< null: the rule held
  int done = 0;                     ///< how often was done what was asked for
};

namespace detail {

/// Calls `holds` with the orders of so many events whose number is wanted, until it returns false; returns
/// what it returned last.
template <std::size_t Length, class Event, class Wanted, class Holds>
bool hold_in_all_orders(const Wanted& is_wanted, const Holds& holds) {
  std::size_t count = 1;
  for (std::size_t i = 0; i < Length; ++i) count *= events_of<Event>;
  std::array<Event, Length> order{};
  for (std::size_t number = 0; number < count; ++number) {
    if (!is_wanted(number)) continue;
    std::size_t rest = number;
    for (Event& event : order) {
      event = static_cast<Event>(rest % events_of<Event>);
      rest /= events_of<Event>;
    }
    if (!holds(std::span<const Event>(order))) return false;
  }
  return true;
}

/// Likewise, of so many orders of five and of six events at random, the same in each run.
template <class Event, class Wanted, class Holds>
bool hold_in_random_orders(std::size_t count, const Wanted& is_wanted, const Holds& holds) {
  std::mt19937 random{32};
  std::array<Event, 6> order{};
  for (std::size_t n = 0; n < count; ++n) {
    for (Event& event : order) event = static_cast<Event>(random() % events_of<Event>);
    if (is_wanted(n) && !holds(std::span<const Event>(order).first(5 + n % 2))) return false;
  }
  return true;
}

}  // namespace detail

/// Calls `attempt` with all orders of `Length` events; with `--full` also with `some` of five and six at
/// random, with `--soak` with `at_random` of these and with all of `Long` (TestExtent). `attempt` returns an
/// OrderOutcome; what goes wrong first is printed by `names` of the events. True: the rule held in all of
/// them, and something was done, for what never does anything proves nothing.
template <class Event, std::size_t Length, std::size_t Long, class Attempt>
bool hold_in_orders(const std::array<const char*, events_of<Event>>& names, std::size_t some,
                    std::size_t at_random, const Attempt& attempt) {
  int done = 0;
  const auto holds = [&](std::span<const Event> order) {
    const OrderOutcome outcome = attempt(order);
    done += outcome.done;
    if (outcome.violation == nullptr) return true;
    std::string text;
    for (const Event event : order)
      text += (text.empty() ? "" : ", ") + std::string(names[static_cast<std::size_t>(event)]);
    std::printf("%s: %s\n", text.c_str(), outcome.violation);
    return false;
  };
  const TestExtent extent = TestExtent::of_environment();
  const auto each = [](std::size_t) { return true; };
  const auto of_the_part = [&](std::size_t number) { return extent.has(number); };
  bool held = detail::hold_in_all_orders<Length, Event>(each, holds);
  if (held && extent.some) held = detail::hold_in_random_orders<Event>(some, each, holds);
  if (held && extent.parts > 0)
    held = detail::hold_in_all_orders<Long, Event>(of_the_part, holds) &&
           detail::hold_in_random_orders<Event>(at_random, of_the_part, holds);
  return held && done > 0;
}

}  // namespace flexrf
