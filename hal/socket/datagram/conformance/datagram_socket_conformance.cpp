#include "hal/socket/datagram/conformance/datagram_socket_conformance.hpp"

#include "tests/conformance.hpp"
#include "tests/recovery.hpp"

namespace flexrf {
namespace {

/// Cycles after which what must happen has happened; those of a real socket take milliseconds.
constexpr int patience = 20000;

MakeDatagramSocketWorld make_world = nullptr;

template <class Condition>
bool until(DatagramSocketWorld& world, Condition is_true) {
  for (int i = 0; i < patience; ++i) {
    world.receive();
    const bool done = is_true();
    world.send();
    if (done) return true;
  }
  return false;
}

using Texts = std::vector<std::string>;

std::span<const std::byte> bytes_of(std::string_view text) {
  return std::as_bytes(std::span(text));
}

std::string text_of(const Datagram& datagram) {
  return {reinterpret_cast<const char*>(datagram.bytes.data()), datagram.bytes.size()};
}

bool hears(DatagramSocketWorld& world, Texts& texts, std::size_t count) {
  return until(world, [&] {
    while (const auto datagram = world.socket().read()) texts.push_back(text_of(*datagram));
    return texts.size() >= count;
  });
}

// [datagram-socket-2] [datagram-socket-3]
Verdict datagrams_go_both_ways_whole(DatagramSocketWorld& world) {
  if (!world.start({})) return Verdict::failed;
  if (!world.socket().write(bytes_of("one")) || !world.socket().write(bytes_of("")) ||
      !world.socket().write(bytes_of(std::string_view("t\0o", 3)))) {
    return Verdict::failed;
  }
  const Texts sent = {"one", "", std::string("t\0o", 3)};
  if (!until(world, [&] { return world.got(FarEnd::peer) == sent; })) return Verdict::failed;
  for (const std::string& text : sent) world.give(FarEnd::peer, text);
  Texts texts;
  return verdict(hears(world, texts, 3) && texts == sent && world.feedback().sent == 3 &&
                 world.feedback().received == 3 && world.feedback().trouble_view().empty());
}

// [datagram-socket-1]
Verdict a_datagram_keeps_its_bytes_until_the_cycle_ends(DatagramSocketWorld& world) {
  if (!world.start({})) return Verdict::failed;
  for (const char* const text : {"a", "b", "c", "d"}) world.give(FarEnd::peer, text);
  if (!until(world, [&] { return world.feedback().received == 4; })) return Verdict::failed;
  std::vector<Datagram> all;
  while (const auto datagram = world.socket().read()) all.push_back(*datagram);
  return verdict(all.size() == 4 && text_of(all[0]) == "a" && text_of(all[3]) == "d" && all[0].at > Time{});
}

Verdict what_others_send_is_dropped(DatagramSocketWorld& world) {
  if (!world.start({})) return Verdict::failed;
  world.give(FarEnd::stranger, "from somebody");
  world.give(FarEnd::peer, "from the peer");
  Texts texts;
  return verdict(hears(world, texts, 1) && texts == Texts{"from the peer"} &&
                 until(world, [&] { return world.feedback().foreign == 1; }));
}

// [datagram-socket-4] [datagram-socket-5]
Verdict who_sent_it_can_be_answered(DatagramSocketWorld& world) {
  if (!world.start({.has_remote = false})) return Verdict::failed;
  if (world.socket().write(bytes_of("to whom"))) return Verdict::failed;
  world.give(FarEnd::peer, "peer");
  world.give(FarEnd::stranger, "stranger");
  std::size_t answered = 0;
  const bool both = until(world, [&] {
    while (const auto datagram = world.socket().read()) {
      if (world.socket().write_to(datagram->from, bytes_of("for the " + text_of(*datagram)))) ++answered;
    }
    return answered == 2;
  });
  return verdict(both &&
                 until(world,
                       [&] {
                         return world.got(FarEnd::peer) == Texts{"for the peer"} &&
                                world.got(FarEnd::stranger) == Texts{"for the stranger"};
                       }) &&
                 world.feedback().refused_writes == 1);
}

Verdict with_a_peer_others_can_be_let_in(DatagramSocketWorld& world) {
  if (!world.start({.only_remote = false})) return Verdict::failed;
  world.give(FarEnd::stranger, "hello");
  Texts texts;
  return verdict(hears(world, texts, 1) && texts == Texts{"hello"} && world.feedback().foreign == 0);
}

// [datagram-socket-4]
Verdict what_is_too_long_is_dropped_and_refused(DatagramSocketWorld& world) {
  if (!world.start({.size = 8})) return Verdict::failed;
  world.give(FarEnd::peer, "123456789");
  world.give(FarEnd::peer, "12345678");
  Texts texts;
  if (!hears(world, texts, 1) || texts != Texts{"12345678"}) return Verdict::failed;
  return verdict(world.feedback().long_datagrams == 1 && !world.socket().write(bytes_of("123456789")) &&
                 world.socket().write(bytes_of("12345678")));
}

// [datagram-socket-2]
Verdict what_nobody_takes_is_counted(DatagramSocketWorld& world) {
  if (!world.start({.waiting = 4})) return Verdict::failed;
  for (int i = 0; i < 10; ++i) world.give(FarEnd::peer, std::to_string(i));
  if (!until(world, [&] { return world.feedback().received + world.feedback().dropped == 10; }))
    return Verdict::failed;
  Texts texts;
  return verdict(hears(world, texts, 4) && texts == Texts{"0", "1", "2", "3"} &&
                 world.feedback().dropped == 6);
}

// [datagram-socket-3] [datagram-socket-4]
Verdict more_than_wait_are_not_written(DatagramSocketWorld& world) {
  if (!world.start({.waiting = 4})) return Verdict::failed;
  for (int i = 0; i < 4; ++i) {
    if (!world.socket().write(bytes_of("x"))) return Verdict::failed;
  }
  if (world.socket().write(bytes_of("x"))) return Verdict::failed;
  return verdict(until(world, [&] { return world.got(FarEnd::peer).size() == 4; }) &&
                 world.socket().write(bytes_of("y")) && world.feedback().refused_writes == 1);
}

/// Whether the loss of a peer is noticed is the network's matter; that it may come back is ours.
Verdict a_peer_that_comes_back_is_heard_again(DatagramSocketWorld& world) {
  if (!world.start({})) return Verdict::failed;
  world.leave();
  for (int i = 0; i < 3; ++i) {
    world.socket().write(bytes_of("lost"));
    world.receive();
    world.send();
  }
  world.come_back();
  const std::optional<Time> since = world.now();
  const bool heard = until(world, [&] {
    world.socket().write(bytes_of("there?"));
    const Texts got = world.got(FarEnd::peer);
    return !got.empty() && got.back() == "there?";
  });
  world.give(FarEnd::peer, "here");
  Texts texts;
  return verdict(heard && hears(world, texts, 1) && texts == Texts{"here"} &&
                 (!since || is_back_in_time("a peer that was away", *world.now() - *since)) &&
                 world.socket().fault().is_ok());
}

Verdict an_address_in_use_is_refused_with_its_cause(DatagramSocketWorld& world) {
  if (!world.occupy()) return Verdict::skipped;
  const Status status = world.start({});
  return verdict(status.code() == StatusCode::busy && status.cause()[0] != '\0');
}

template <Verdict (*Run)(DatagramSocketWorld&)>
void judged(void**) {
  judge(make_world, Run);
}

}  // namespace

int run_datagram_socket_conformance(const char* driver, MakeDatagramSocketWorld make) {
  make_world = make;
#define CASE(name) \
  { #name, judged < name>, nullptr, nullptr, nullptr }
  const CMUnitTest tests[] = {
      CASE(datagrams_go_both_ways_whole),          CASE(a_datagram_keeps_its_bytes_until_the_cycle_ends),
      CASE(what_others_send_is_dropped),           CASE(who_sent_it_can_be_answered),
      CASE(with_a_peer_others_can_be_let_in),      CASE(what_is_too_long_is_dropped_and_refused),
      CASE(what_nobody_takes_is_counted),          CASE(more_than_wait_are_not_written),
      CASE(a_peer_that_comes_back_is_heard_again), CASE(an_address_in_use_is_refused_with_its_cause),
  };
#undef CASE
  return cmocka_run_group_tests_name(driver, tests, nullptr, nullptr);
}

}  // namespace flexrf
