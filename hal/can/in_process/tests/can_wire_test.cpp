#include "hal/can/in_process/can_wire.hpp"

#include <memory>
#include <vector>

#include "hal/can/in_process/can_bit_count.hpp"
#include "tests/cmocka.hpp"

namespace {

using namespace flexrf;
using std::chrono::microseconds;
using std::chrono::milliseconds;

constexpr Time start{std::chrono::seconds(1)};

constexpr CanFrame frame_of(std::uint32_t identifier, std::uint8_t length = 8) {
  CanFrame frame;
  frame.identifier = identifier;
  frame.length = length;
  return frame;
}

static_assert(bit_count(frame_of(0x201)) + intermission_bits == 135);
static_assert(bit_count(frame_of(0x080, 0)) + intermission_bits == 55);
static_assert(bit_count({.identifier = 0x201, .length = 8, .extended = true}) + intermission_bits == 160);
static_assert(bit_count({.identifier = 0x201, .length = 8, .remote = true}) == bit_count(frame_of(0x201, 0)));
// ISO 11898-1: the base frame before the extended one with the same eleven bits, data before a request for
// it.
// [can-frame-2]
static_assert(arbitration_key({.identifier = 0x123}) <
              arbitration_key({.identifier = 0x123, .remote = true}));
static_assert(arbitration_key({.identifier = 0x123, .remote = true}) <
              arbitration_key({.identifier = 0x123U << 18U, .extended = true}));
static_assert(arbitration_key({.identifier = 0x123U << 18U | 0x3FFFF, .extended = true}) <
              arbitration_key({.identifier = 0x124}));

class Listener final : public CanNode {
 public:
  void on_frame(const CanFrame& frame, CanPort& port) noexcept override {
    heard.push_back(frame);
    if (answers_with != 0) port.send(frame_of(answers_with));
  }
  Time next_event() const noexcept override { return acts_at; }
  void on_time(Time now, CanPort& /*port*/) noexcept override {
    acted.push_back(now);
    acts_at = Time::max();
  }
  std::vector<CanFrame> heard;
  std::vector<Time> acted;
  Time acts_at = Time::max();
  std::uint32_t answers_with = 0;
};

/// Two nodes and one that only listens, on a wire of 1 Mbit/s: a bit is a microsecond.
struct Wire {
  explicit Wire(const CanWire::Settings& settings = {}) {
    wire.reset(settings);
    wire.advance(start);
  }
  ~Wire() {
    for (Listener* node : {&a, &b, &listener}) wire.detach(*node);
  }
  CanWire wire;
  Listener a, b, listener;
  CanStation* to_a = wire.attach(a);
  CanStation* to_b = wire.attach(b);
  CanStation* to_listener = wire.attach(listener);
};

bool a_frame_takes_its_bits() {
  Wire w;
  if (!w.to_a->send(frame_of(0x201))) return false;
  w.wire.advance(start + microseconds(131));
  const bool early = !w.b.heard.empty();
  w.wire.advance(start + microseconds(132));
  return !early && w.b.heard.size() == 1 && w.b.heard[0].time == start + microseconds(132) &&
         w.a.heard.empty() && w.listener.heard.size() == 1 && w.to_a->sent() == 1;
}

bool the_lowest_identifier_goes_first() {
  Wire w;
  w.to_a->send(frame_of(0x300));
  w.wire.advance(start + microseconds(10));  // a's is on the wire, nothing stops it
  w.to_a->send(frame_of(0x200));
  w.to_b->send(frame_of(0x201));
  w.to_b->send(frame_of(0x080, 0));
  w.wire.advance(start + milliseconds(2));
  const auto& heard = w.listener.heard;
  const std::uint32_t order[] = {0x300, 0x080, 0x200, 0x201};
  if (heard.size() != 4) return false;
  for (std::size_t i = 0; i < 4; ++i) {
    if (heard[i].identifier != order[i]) return false;
  }
  // Back to back, three bits between.
  return heard[1].time == heard[0].time + microseconds(3 + 52) &&
         heard[2].time == heard[1].time + microseconds(135) && w.to_a->arbitrations_lost() == 1 &&
         w.to_b->arbitrations_lost() == 1;
}

bool cadence_does_not_matter() {
  const auto run = [](Duration step) {
    Wire w({.corrupted_share = 0.2, .seed = 7});
    w.a.answers_with = 0x181;
    w.listener.acts_at = start + microseconds(777);
    for (std::uint32_t i = 0; i < 20; ++i) w.to_b->send(frame_of(0x201 + i));
    for (Time now = start; now < start + milliseconds(20); now += step) w.wire.advance(now);
    w.wire.advance(start + milliseconds(20));
    std::vector<Time> times;
    for (const CanFrame& frame : w.listener.heard) times.push_back(frame.time);
    times.insert(times.end(), w.listener.acted.begin(), w.listener.acted.end());
    return times;
  };
  const std::vector<Time> fine = run(microseconds(13));
  return fine.size() == 42 && fine == run(milliseconds(1)) && fine == run(milliseconds(20));
}

bool a_hit_frame_is_repeated_and_counted() {
  Wire w;
  w.to_a->corrupt_next(1);
  w.to_a->send(frame_of(0x201));
  w.wire.advance(start + microseconds(140));
  const bool counted =
      w.to_a->transmit_errors() == 8 && w.to_b->receive_errors() == 1 && w.listener.heard.empty();
  w.wire.advance(start + milliseconds(1));
  return counted && w.listener.heard.size() == 1 && w.to_a->transmit_errors() == 7 &&
         w.to_b->receive_errors() == 0 && w.to_a->failed() == 1 &&
         w.listener.heard[0].time == start + microseconds(132 + 20 + 3 + 132);
}

bool too_many_errors_take_it_off_the_bus() {
  Wire w({.restart_after = milliseconds(10)});
  w.to_a->corrupt_next(1000);
  w.to_a->send(frame_of(0x201));
  w.wire.advance(start + microseconds(16 * 155 + 1));
  const bool passive = w.to_a->state() == CanBusState::error_passive;
  w.wire.advance(start + milliseconds(6));
  const bool off = w.to_a->state() == CanBusState::bus_off && !w.to_a->send(frame_of(0x201)) &&
                   w.to_a->failed() == 32 && w.to_a->waiting() == 0;
  w.to_a->corrupt_next(0);
  w.wire.advance(start + milliseconds(20));
  const bool back = w.to_a->state() == CanBusState::error_active && w.to_a->send(frame_of(0x201));
  w.wire.advance(start + milliseconds(21));
  return passive && off && back && w.listener.heard.size() == 1;
}

bool without_a_restart_it_stays_off() {
  Wire w;
  w.to_a->corrupt_next(32);
  w.to_a->send(frame_of(0x201));
  w.wire.advance(start + std::chrono::seconds(100));
  return w.to_a->state() == CanBusState::bus_off;
}

bool alone_it_becomes_passive_and_stays() {
  Wire w;
  w.to_b->set_connected(false);
  w.to_listener->set_connected(false);
  w.to_a->send(frame_of(0x201));
  w.wire.advance(start + milliseconds(100));
  const bool passive = w.to_a->state() == CanBusState::error_passive && w.to_a->waiting() == 1;
  w.to_b->set_connected(true);
  w.wire.advance(start + milliseconds(101));
  return passive && w.b.heard.size() == 1 && w.listener.heard.empty() && w.to_a->waiting() == 0;
}

bool a_plug_that_is_out_delays_nobody() {
  Wire w;
  w.to_a->set_connected(false);
  w.to_a->send(frame_of(0x001));
  w.to_b->send(frame_of(0x201));
  w.wire.advance(start + microseconds(132));
  const bool undisturbed =
      w.listener.heard.size() == 1 && w.a.heard.empty() && w.to_a->state() == CanBusState::error_passive;
  w.to_a->set_connected(true);
  w.wire.advance(start + milliseconds(1));
  return undisturbed && w.listener.heard.size() == 2;
}

bool a_node_hears_what_it_asked_for() {
  Wire w;
  Listener picky;
  const CanIdentifier wanted[] = {{0x080}, {0x12345, true}};
  w.wire.attach(picky, wanted);
  for (const std::uint32_t identifier : {0x080U, 0x081U}) w.to_a->send(frame_of(identifier));
  for (const std::uint32_t identifier : {0x12345U, 0x12346U})
    w.to_a->send({.identifier = identifier, .extended = true});
  w.wire.advance(start + milliseconds(2));
  const bool heard = picky.heard.size() == 2 && w.listener.heard.size() == 4;
  w.wire.detach(picky);
  w.to_a->send(frame_of(0x080));
  w.wire.advance(start + milliseconds(3));
  return heard && picky.heard.size() == 2 && w.listener.heard.size() == 5;
}

bool there_are_only_so_many_places() {
  CanWire wire;
  std::vector<Listener> nodes(CanWire::most_nodes + 1);
  for (std::size_t i = 0; i < CanWire::most_nodes; ++i) {
    if (wire.attach(nodes[i]) == nullptr) return false;
  }
  const bool full = wire.attach(nodes.back()) == nullptr;
  wire.detach(nodes.front());
  return full && wire.attach(nodes.back()) != nullptr;
}

bool says_when_something_will_happen() {
  Wire w;
  w.wire.advance(start);
  const bool quiet = w.wire.next_event() == Time::max();
  w.to_a->send(frame_of(0x201));
  w.wire.advance(start + microseconds(50));
  return quiet && w.wire.next_event() == start + microseconds(132);
}

// Ever more than leave, up to the last place, and then as many as leave.
bool a_queue_that_is_never_empty_keeps_its_order() {
  const auto queue = std::make_unique<CanSendQueue>();
  std::uint8_t put = 0;
  std::uint8_t left = 0;
  const auto say = [&](std::uint32_t identifier, std::uint8_t number) {
    CanFrame frame = frame_of(identifier);
    frame.data[0] = number;
    return queue->put(frame, false);
  };
  for (int i = 0; i < 5000; ++i) {
    if (queue->size() < CanSendQueue::capacity && !say(0x201, put++)) return false;
    if (i % 3 == 0) continue;
    if ((*queue)[0].data[0] != left++) return false;
    queue->drop_one_of(queue->first_key());
  }
  while (queue->size() < CanSendQueue::capacity) static_cast<void>(say(0x201, put++));
  if (say(0x080, 0)) return false;
  queue->drop_first(2);
  if (!say(0x080, 1) || !say(0x300, 2) || say(0x300, 3)) return false;
  const bool ordered = (*queue)[0].identifier == 0x080 && (*queue)[CanSendQueue::capacity - 1].data[0] == 2;
  return ordered && (*queue)[1].data[0] == static_cast<std::uint8_t>(left + 2);
}

template <bool (*Run)()>
void holds(void**) {
  assert_true(Run());
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      {"a frame takes its bits", holds<a_frame_takes_its_bits>, nullptr, nullptr, nullptr},
      {"the lowest identifier goes first", holds<the_lowest_identifier_goes_first>, nullptr, nullptr,
       nullptr},
      {"cadence does not matter", holds<cadence_does_not_matter>, nullptr, nullptr, nullptr},
      {"a hit frame is repeated", holds<a_hit_frame_is_repeated_and_counted>, nullptr, nullptr, nullptr},
      {"too many errors: off the bus", holds<too_many_errors_take_it_off_the_bus>, nullptr, nullptr, nullptr},
      {"no restart: stays off", holds<without_a_restart_it_stays_off>, nullptr, nullptr, nullptr},
      {"alone: passive for ever", holds<alone_it_becomes_passive_and_stays>, nullptr, nullptr, nullptr},
      {"a plug that is out", holds<a_plug_that_is_out_delays_nobody>, nullptr, nullptr, nullptr},
      {"hears what it asked for", holds<a_node_hears_what_it_asked_for>, nullptr, nullptr, nullptr},
      {"only so many places", holds<there_are_only_so_many_places>, nullptr, nullptr, nullptr},
      {"a queue that is never empty", holds<a_queue_that_is_never_empty_keeps_its_order>, nullptr, nullptr,
       nullptr},
      {"says when something will happen", holds<says_when_something_will_happen>, nullptr, nullptr, nullptr},
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
