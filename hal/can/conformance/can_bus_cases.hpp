// What the cases of CanBus have in common.
#pragma once

#include <algorithm>
#include <vector>

#include "hal/can/conformance/can_bus_conformance.hpp"
#include "tests/verdict.hpp"

namespace flexrf::can_bus_cases {

/// Far more than any of it takes; a world in real time sleeps a millisecond in each.
inline constexpr int most_cycles = 20'000;
/// After which what has not happened is taken not to happen.
inline constexpr int settling_cycles = 20;

inline CanFrame frame_of(std::uint32_t identifier, std::uint8_t first = 0, bool extended = false) {
  CanFrame frame;
  frame.identifier = identifier;
  frame.extended = extended;
  frame.length = 2;
  frame.data[0] = first;
  frame.data[1] = 0xA5;
  return frame;
}

inline bool is_same(const CanFrame& left, const CanFrame& right) {
  return left.identifier == right.identifier && left.extended == right.extended &&
         left.remote == right.remote && left.length == right.length &&
         std::equal(left.data.begin(), left.data.begin() + left.length, right.data.begin());
}

inline void cycle(CanBusWorld& world, int times = 1) {
  for (int i = 0; i < times; ++i) {
    world.receive();
    world.send();
  }
}

template <class Condition>
bool await(CanBusWorld& world, Condition condition) {
  for (int i = 0; i < most_cycles; ++i) {
    if (condition()) return true;
    cycle(world);
  }
  return condition();
}

inline bool opens(CanBusWorld& world, CanInbox& inbox, const std::vector<CanIdentifier>& identifiers,
                  std::uint32_t capacity = 32) {
  return world.bus().open(inbox, identifiers, capacity).is_ok();
}

inline std::optional<CanFrame> next_of(CanBusWorld& world, CanInbox& inbox) {
  return await(world, [&] { return !inbox.is_empty(); }) ? inbox.pop() : std::nullopt;
}

inline std::vector<CanFrame> heard(CanBusWorld& world, std::size_t count) {
  std::vector<CanFrame> frames;
  await(world, [&] {
    while (const std::optional<CanFrame> frame = world.hear()) frames.push_back(*frame);
    return frames.size() >= count;
  });
  return frames;
}

// ---- the bus is lost and comes back: bus_loss_cases.cpp

Verdict comes_back_after_it_was_down(CanBusWorld& world);
Verdict comes_back_after_it_was_gone(CanBusWorld& world);
Verdict comes_back_after_bus_off(CanBusWorld& world);
Verdict works_while_error_passive(CanBusWorld& world);
Verdict what_waits_is_given_up_when_it_goes_down(CanBusWorld& world);

}  // namespace flexrf::can_bus_cases
