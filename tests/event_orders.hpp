// All orders in which some events can come, and more at random: for rules that have to hold whatever comes
// first.
#pragma once

#include <array>
#include <cstddef>
#include <cstdlib>
#include <random>
#include <span>
#include <string>

namespace flexrf {

/// `--full` runs the tests in which more is tried (FLEXRF_LONG).
inline bool is_long_run() {
  return std::getenv("FLEXRF_LONG") != nullptr;
}

/// `Event`: an enumeration that begins at 0 and ends with `count`.
template <class Event>
inline constexpr std::size_t events_of = static_cast<std::size_t>(Event::count);

/// Calls `holds` with all orders of so many events, until it returns false; returns what it returned last.
template <std::size_t Length, class Event, class Holds>
bool hold_in_all_orders(const Holds& holds) {
  std::size_t count = 1;
  for (std::size_t i = 0; i < Length; ++i) count *= events_of<Event>;
  std::array<Event, Length> order{};
  for (std::size_t number = 0; number < count; ++number) {
    std::size_t rest = number;
    for (Event& event : order) {
      event = static_cast<Event>(rest % events_of<Event>);
      rest /= events_of<Event>;
    }
    if (!holds(std::span<const Event>(order))) return false;
  }
  return true;
}

/// Likewise, with so many orders of five and of six events, the same in each run.
template <class Event, class Holds>
bool hold_in_random_orders(int count, const Holds& holds) {
  std::mt19937 random{32};
  std::array<Event, 6> order{};
  for (int n = 0; n < count; ++n) {
    for (Event& event : order) event = static_cast<Event>(random() % events_of<Event>);
    if (!holds(std::span<const Event>(order).first(5 + static_cast<std::size_t>(n) % 2))) return false;
  }
  return true;
}

/// "stop, start, silent". `names`: of the events, in their order.
template <class Event>
std::string described(std::span<const Event> order, std::span<const char* const> names) {
  std::string text;
  for (const Event event : order)
    text += (text.empty() ? "" : ", ") + std::string(names[static_cast<std::size_t>(event)]);
  return text;
}

}  // namespace flexrf
