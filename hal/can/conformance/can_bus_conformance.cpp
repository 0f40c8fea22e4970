#include "hal/can/conformance/can_bus_conformance.hpp"

#include <cstring>

#include "hal/can/conformance/can_bus_cases.hpp"
#include "tests/conformance.hpp"

namespace flexrf {
namespace {

using namespace can_bus_cases;

MakeCanBusWorld make_world = nullptr;

// [can-bus-3]
Verdict delivers_what_is_wanted_and_nothing_else(CanBusWorld& world) {
  CanInbox inbox;
  if (!opens(world, inbox, {{0x181}, {0x7FF}})) return Verdict::failed;
  world.say(frame_of(0x181, 1));
  world.say(frame_of(0x182, 2));
  world.say(frame_of(0x7FF, 3));
  const auto first = next_of(world, inbox);
  const auto second = next_of(world, inbox);
  return verdict(first && is_same(*first, frame_of(0x181, 1)) && second &&
                 is_same(*second, frame_of(0x7FF, 3)) && inbox.is_empty() &&
                 world.bus().counters().frames_received == 2);
}

// [can-bus-5]
Verdict two_devices_may_want_the_same(CanBusWorld& world) {
  CanInbox one;
  CanInbox other;
  if (!opens(world, one, {{0x701}}) || !opens(world, other, {{0x701}, {0x702}})) return Verdict::failed;
  world.say(frame_of(0x701, 1));
  world.say(frame_of(0x702, 2));
  const auto first = next_of(world, one);
  const auto second = next_of(world, other);
  const auto third = next_of(world, other);
  return verdict(first && second && is_same(*first, *second) && third &&
                 is_same(*third, frame_of(0x702, 2)) && one.is_empty());
}

// [can-bus-3]
Verdict tells_long_identifiers_from_short_ones(CanBusWorld& world) {
  CanInbox shorter;
  CanInbox longer;
  if (!opens(world, shorter, {{0x123}}) || !opens(world, longer, {{0x123, true}, {0x1FFF'FFFF, true}}))
    return Verdict::failed;
  world.say(frame_of(0x123, 1, true));
  world.say(frame_of(0x1FFF'FFFF, 2, true));
  world.say(frame_of(0x123, 3));
  const auto last = next_of(world, shorter);
  const auto first = next_of(world, longer);
  const auto second = next_of(world, longer);
  return verdict(last && is_same(*last, frame_of(0x123, 3)) && first &&
                 is_same(*first, frame_of(0x123, 1, true)) && second &&
                 is_same(*second, frame_of(0x1FFF'FFFF, 2, true)) && shorter.is_empty() && longer.is_empty());
}

// [can-frame-1]
Verdict stamps_with_the_time_of_reception(CanBusWorld& world) {
  CanInbox inbox;
  if (!opens(world, inbox, {{0x181}})) return Verdict::failed;
  cycle(world, 3);
  const Time before = world.now();
  world.say(frame_of(0x181, 1));
  const auto first = next_of(world, inbox);
  const Time between = world.now();
  world.say(frame_of(0x181, 2));
  const auto second = next_of(world, inbox);
  const Time after = world.now();
  return verdict(first && second && first->time >= before && first->time <= between &&
                 second->time >= between && second->time <= after);
}

// [can-bus-3] [can-inbox-1]
Verdict takes_a_burst(CanBusWorld& world) {
  constexpr int count = 250;
  CanInbox inbox;
  if (!opens(world, inbox, {{0x300}}, 256)) return Verdict::failed;
  for (int i = 0; i < count; ++i) world.say(frame_of(0x300, static_cast<std::uint8_t>(i)));
  for (int i = 0; i < count; ++i) {
    const auto frame = next_of(world, inbox);
    if (!frame || frame->data[0] != i) return Verdict::failed;
  }
  return verdict(inbox.missed() == 0 && world.bus().counters().frames_missed == 0);
}

// [can-bus-4] [can-inbox-2]
Verdict a_full_inbox_keeps_the_newest(CanBusWorld& world) {
  CanInbox small;
  CanInbox all;
  if (!opens(world, small, {{0x181}}, 4) || !opens(world, all, {{0x181}}, 32)) return Verdict::failed;
  for (std::uint8_t i = 0; i < 10; ++i) world.say(frame_of(0x181, i));
  for (std::uint8_t i = 0; i < 10; ++i) {
    if (!next_of(world, all)) return Verdict::failed;
  }
  for (std::uint8_t i = 6; i < 10; ++i) {
    const auto frame = small.pop();
    if (!frame || frame->data[0] != i) return Verdict::failed;
  }
  return verdict(small.is_empty() && small.missed() == 6 && world.bus().counters().frames_missed == 6);
}

// [can-bus-7]
Verdict a_closed_inbox_gets_nothing(CanBusWorld& world) {
  CanInbox closed;
  CanInbox open;
  if (!opens(world, closed, {{0x181}}) || !opens(world, open, {{0x181}})) return Verdict::failed;
  world.bus().close(closed);
  world.say(frame_of(0x181));
  return verdict(next_of(world, open).has_value() && closed.is_empty());
}

// [can-bus-12]
Verdict an_inbox_that_is_open_is_opened_anew(CanBusWorld& world) {
  CanInbox inbox;
  CanInbox all;
  if (!opens(world, inbox, {{0x181}}, 2) || !opens(world, all, {{0x181}, {0x182}})) return Verdict::failed;
  for (std::uint8_t i = 0; i < 3; ++i) world.say(frame_of(0x181, i));
  for (int i = 0; i < 3; ++i) {
    if (!next_of(world, all)) return Verdict::failed;
  }
  if (inbox.is_empty() || inbox.missed() != 1) return Verdict::failed;
  if (!opens(world, inbox, {{0x182}}) || !inbox.is_empty() || inbox.missed() != 0) return Verdict::failed;
  world.say(frame_of(0x181, 4));
  world.say(frame_of(0x182, 5));
  const auto frame = next_of(world, inbox);
  return verdict(frame && is_same(*frame, frame_of(0x182, 5)) && inbox.is_empty());
}

// [can-bus-6]
Verdict refuses_identifiers_that_cannot_be(CanBusWorld& world) {
  CanInbox inbox;
  return verdict(!opens(world, inbox, {{0x800}}) && !opens(world, inbox, {{0x2000'0000, true}}) &&
                 !opens(world, inbox, {}) && opens(world, inbox, {{0x7FF}}));
}

// [can-bus-1] [can-bus-9] [can-send-queue-1]
// [can-bus-13]
Verdict a_node_has_one_owner(CanBusWorld& world) {
  constexpr char left[] = "left";
  constexpr char right[] = "right";
  CanBus& bus = world.bus();
  if (!bus.claim_node(5, left) || !bus.claim_node(5, left) || !bus.claim_node(6, right))
    return Verdict::failed;
  const Status refused = bus.claim_node(5, right);
  if (refused || std::strstr(refused.cause(), "node 5") == nullptr ||
      std::strstr(refused.cause(), "`left`") == nullptr)
    return Verdict::failed;
  // An owner that claims another node releases its former one; release_node() releases all that it has.
  if (!bus.claim_node(7, left) || !bus.claim_node(5, right)) return Verdict::failed;
  bus.release_node(left);
  bus.release_node(right);
  const bool are_free = bus.claim_node(5, left).is_ok() && bus.claim_node(7, right).is_ok();
  bus.release_node(left);
  bus.release_node(right);
  return verdict(are_free);
}

Verdict sends_the_most_urgent_first(CanBusWorld& world) {
  world.receive();
  // As devices do it: the process data first, and SYNC by the one that comes last.
  const bool queued = world.bus().queue(frame_of(0x601, 1)) && world.bus().post(frame_of(0x202, 2)) &&
                      world.bus().post(frame_of(0x201, 3)) && world.bus().queue(frame_of(0x601, 4)) &&
                      world.bus().post(frame_of(0x080, 5));
  world.send();
  const std::vector<CanFrame> frames = heard(world, 5);
  const std::uint8_t order[] = {5, 3, 2, 1, 4};
  bool in_order = frames.size() == 5;
  for (std::size_t i = 0; in_order && i < 5; ++i) in_order = frames[i].data[0] == order[i];
  return verdict(queued && in_order && world.bus().counters().frames_sent == 5);
}

// [can-bus-10]
Verdict what_is_posted_twice_is_said_once(CanBusWorld& world) {
  world.receive();
  const bool posted = world.bus().post(frame_of(0x201, 1)) && world.bus().post(frame_of(0x080, 2)) &&
                      world.bus().post(frame_of(0x201, 3)) && world.bus().post(frame_of(0x080, 4)) &&
                      world.bus().queue(frame_of(0x700, 5)) && world.bus().queue(frame_of(0x700, 6));
  world.send();
  const std::vector<CanFrame> frames = heard(world, 4);
  return verdict(posted && frames.size() == 4 && frames[0].data[0] == 4 && frames[1].data[0] == 3 &&
                 frames[2].data[0] == 5 && frames[3].data[0] == 6);
}

Verdict sends_every_kind_of_frame(CanBusWorld& world) {
  CanFrame empty;
  empty.identifier = 0x080;
  CanFrame full = frame_of(0x1ABC'DEF0, 1, true);
  full.length = 8;
  full.data[7] = 0x77;
  CanFrame request;
  request.identifier = 0x701;
  request.remote = true;
  world.receive();
  const bool queued = world.bus().queue(empty) && world.bus().queue(full) && world.bus().queue(request);
  world.send();
  const std::vector<CanFrame> frames = heard(world, 3);
  return verdict(queued && frames.size() == 3 && is_same(frames[0], empty) && is_same(frames[1], full) &&
                 is_same(frames[2], request));
}

// [can-bus-8]
Verdict refuses_frames_that_cannot_be(CanBusWorld& world) {
  CanFrame long_one = frame_of(0x100);
  long_one.length = 9;
  world.receive();
  const bool refused = !world.bus().queue(long_one) && !world.bus().queue(frame_of(0x800)) &&
                       !world.bus().post(frame_of(0x2000'0000, 0, true));
  return verdict(refused && world.bus().counters().frames_refused == 3);
}

// [can-bus-8] [can-bus-9]
Verdict a_full_queue_says_so_and_empties(CanBusWorld& world) {
  constexpr std::size_t count = CanSendQueue::capacity;
  world.receive();
  bool queued = true;
  for (std::size_t i = 0; i < count; ++i) {
    queued = queued && world.bus().queue(frame_of(0x200, static_cast<std::uint8_t>(i)));
  }
  const bool refused = !world.bus().queue(frame_of(0x201));
  world.send();
  const std::vector<CanFrame> frames = heard(world, count);
  bool in_order = frames.size() == count;
  for (std::size_t i = 0; in_order && i < count; ++i) in_order = frames[i].data[0] == i;
  world.receive();
  const bool has_room = world.bus().queue(frame_of(0x201));
  return verdict(queued && refused && in_order && has_room && world.bus().counters().frames_refused == 1 &&
                 world.bus().counters().frames_discarded == 0);
}

template <Verdict (*Run)(CanBusWorld&)>
void judged(void**) {
  judge(make_world, Run);
}

}  // namespace

int run_can_bus_conformance(const char* driver, MakeCanBusWorld make) {
  make_world = make;
  const CMUnitTest tests[] = {
      {"delivers what is wanted and nothing else", judged<delivers_what_is_wanted_and_nothing_else>, nullptr,
       nullptr, nullptr},
      {"two devices may want the same", judged<two_devices_may_want_the_same>, nullptr, nullptr, nullptr},
      {"tells long identifiers from short ones", judged<tells_long_identifiers_from_short_ones>, nullptr,
       nullptr, nullptr},
      {"stamps with the time of reception", judged<stamps_with_the_time_of_reception>, nullptr, nullptr,
       nullptr},
      {"takes a burst", judged<takes_a_burst>, nullptr, nullptr, nullptr},
      {"a full inbox keeps the newest", judged<a_full_inbox_keeps_the_newest>, nullptr, nullptr, nullptr},
      {"a closed inbox gets nothing", judged<a_closed_inbox_gets_nothing>, nullptr, nullptr, nullptr},
      {"an inbox that is open is opened anew", judged<an_inbox_that_is_open_is_opened_anew>, nullptr, nullptr,
       nullptr},
      {"refuses identifiers that cannot be", judged<refuses_identifiers_that_cannot_be>, nullptr, nullptr,
       nullptr},
      {"a node has one owner", judged<a_node_has_one_owner>, nullptr, nullptr, nullptr},
      {"sends the most urgent first", judged<sends_the_most_urgent_first>, nullptr, nullptr, nullptr},
      {"what is posted twice is said once", judged<what_is_posted_twice_is_said_once>, nullptr, nullptr,
       nullptr},
      {"sends every kind of frame", judged<sends_every_kind_of_frame>, nullptr, nullptr, nullptr},
      {"refuses frames that cannot be", judged<refuses_frames_that_cannot_be>, nullptr, nullptr, nullptr},
      {"a full queue says so and empties", judged<a_full_queue_says_so_and_empties>, nullptr, nullptr,
       nullptr},
      {"comes back after it was down", judged<comes_back_after_it_was_down>, nullptr, nullptr, nullptr},
      {"comes back after it was gone", judged<comes_back_after_it_was_gone>, nullptr, nullptr, nullptr},
      {"comes back after bus off", judged<comes_back_after_bus_off>, nullptr, nullptr, nullptr},
      {"works while error passive", judged<works_while_error_passive>, nullptr, nullptr, nullptr},
      {"what waits is given up when it goes down", judged<what_waits_is_given_up_when_it_goes_down>, nullptr,
       nullptr, nullptr},
  };
  return cmocka_run_group_tests_name(driver, tests, nullptr, nullptr);
}

}  // namespace flexrf
