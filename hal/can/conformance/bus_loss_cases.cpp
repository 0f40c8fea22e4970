#include <string>

#include "hal/can/conformance/can_bus_cases.hpp"
#include "tests/log_ear.hpp"
#include "tests/recovery.hpp"

namespace flexrf::can_bus_cases {
namespace {

// What the operator reads.
bool is_told(const LogEar& log, CanBusState lost) {
  return log.has_heard(std::string("the bus is not usable: ") + name_of(lost) + "; ");
}

// Sends and receives as it did before.
bool works(CanBusWorld& world, CanInbox& inbox) {
  while (world.hear()) {
  }
  const bool sends =
      await(world, [&] { return world.bus().queue(frame_of(0x201, 0x5A)); }) && await(world, [&] {
        const auto frame = world.hear();
        return frame && is_same(*frame, frame_of(0x201, 0x5A));
      });
  while (inbox.pop()) {
  }
  world.say(frame_of(0x181, 0x5B));
  const auto frame = next_of(world, inbox);
  return sends && frame && is_same(*frame, frame_of(0x181, 0x5B));
}

Verdict comes_back(CanBusWorld& world, CanBusState lost, bool (CanBusWorld::*lose)(),
                   bool (CanBusWorld::*restore)()) {
  CanInbox inbox;
  if (!opens(world, inbox, {{0x181}})) return Verdict::failed;
  cycle(world);
  const LogEar log;
  if (!(world.*lose)()) return Verdict::skipped;
  if (!await(world, [&] { return world.bus().state() == lost; })) return Verdict::failed;
  const bool refused = !world.bus().queue(frame_of(0x201));
  cycle(world, settling_cycles);
  const bool stays = world.bus().state() == lost && world.bus().fault().is_ok() && is_told(log, lost);
  if (!(world.*restore)()) return Verdict::failed;
  const Time restored = world.now();
  const bool back = await(world, [&] { return world.bus().is_usable(); }) && works(world, inbox) &&
                    is_back_in_time(name_of(lost), world.now() - restored);
  return verdict(refused && stays && back && world.bus().counters().recoveries == 1 &&
                 world.bus().counters().frames_refused >= 1);
}

}  // namespace

// [can-bus-2] [can-bus-8]
Verdict comes_back_after_it_was_down(CanBusWorld& world) {
  return comes_back(world, CanBusState::down, &CanBusWorld::set_down, &CanBusWorld::set_up);
}
// [can-bus-2] [can-bus-8]
Verdict comes_back_after_it_was_gone(CanBusWorld& world) {
  return comes_back(world, CanBusState::gone, &CanBusWorld::take_away, &CanBusWorld::put_back);
}

// [can-bus-2] [can-bus-8]
Verdict comes_back_after_bus_off(CanBusWorld& world) {
  CanInbox inbox;
  if (!opens(world, inbox, {{0x181}})) return Verdict::failed;
  cycle(world);
  const LogEar log;
  if (!world.cause_bus_off()) return Verdict::skipped;
  const bool off = await(world, [&] { return world.bus().state() == CanBusState::bus_off; });
  const bool refused = !world.bus().queue(frame_of(0x201)) && is_told(log, CanBusState::bus_off);
  world.end_bus_off();
  const Time ended = world.now();
  const bool back = await(world, [&] { return world.bus().is_usable(); }) && works(world, inbox) &&
                    is_back_in_time(name_of(CanBusState::bus_off), world.now() - ended);
  return verdict(off && refused && back && world.bus().counters().bus_offs == 1 &&
                 world.bus().counters().recoveries == 1);
}

Verdict works_while_error_passive(CanBusWorld& world) {
  CanInbox inbox;
  if (!opens(world, inbox, {{0x181}})) return Verdict::failed;
  cycle(world);
  if (!world.cause_error_passive()) return Verdict::skipped;
  const bool passive = await(world, [&] { return world.bus().state() == CanBusState::error_passive; });
  return verdict(passive && works(world, inbox) && world.bus().counters().recoveries == 0);
}

Verdict what_waits_is_given_up_when_it_goes_down(CanBusWorld& world) {
  world.receive();
  if (!world.bus().queue(frame_of(0x201, 1))) return Verdict::failed;
  // Queued, and not yet sent.
  if (!world.set_down()) return Verdict::skipped;
  const bool down = await(world, [&] {
    world.receive();
    return world.bus().state() == CanBusState::down;
  });
  const CanBus::Feedback counters = world.bus().counters();
  return verdict(down && counters.frames_discarded + counters.frames_sent == 1);
}

}  // namespace flexrf::can_bus_cases
