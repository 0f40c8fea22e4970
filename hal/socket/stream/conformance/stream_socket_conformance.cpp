#include "hal/socket/stream/conformance/stream_socket_conformance.hpp"

#include <ctime>
#include <vector>

#include "tests/conformance.hpp"
#include "tests/recovery.hpp"

namespace flexrf {
namespace {

/// Cycles after which what must happen has happened; those of a real socket take milliseconds.
constexpr int patience = 20000;

MakeStreamSocketWorld make_world = nullptr;

template <class Condition>
bool until(StreamSocketWorld& world, Condition is_true) {
  for (int i = 0; i < patience; ++i) {
    world.receive();
    const bool done = is_true();
    world.send();
    if (done) return true;
  }
  return false;
}

/// So many connections, and no more.
bool has(StreamSocketWorld& world, std::size_t count) {
  return until(world, [&] { return world.socket().sessions().size() == count; });
}

bool connected(StreamSocketWorld& world, const StreamWishes& wishes = {}) {
  world.listen(true);
  return world.start(wishes).is_ok() && has(world, 1) &&
         until(world, [&] { return world.connections() == 1; });
}

/// `since`: the world's time when the cause why there was no connection was gone.
bool is_in_time(const StreamSocketWorld& world, std::optional<Time> since, const char* from) {
  return !since || is_back_in_time(from, *world.now() - *since);
}

/// Of a driver that does nothing more: what it did is on its way through the kernel.
bool sees_its_end(StreamSocketWorld& world, std::size_t number) {
  for (int i = 0; i < patience && !world.is_ended(number); ++i) {
    const timespec pause{0, 1'000'000};
    nanosleep(&pause, nullptr);
  }
  return world.is_ended(number);
}

/// Peer after peer, so that each is its number's.
bool listening(StreamSocketWorld& world, const StreamWishes& wishes, std::size_t peers) {
  if (!world.start(wishes)) return false;
  for (std::size_t i = 0; i < peers; ++i) {
    world.connect();
    if (!has(world, i + 1)) return false;
  }
  return true;
}

/// Lines of one connection, until there are so many.
bool hears(StreamSocketWorld& world, SocketSession session, std::vector<std::string>& lines,
           std::size_t count) {
  return until(world, [&] {
    while (const auto line = world.socket().read_line(session)) lines.emplace_back(*line);
    return lines.size() >= count;
  });
}

using Lines = std::vector<std::string>;

// [stream-socket-4] [stream-socket-6]
Verdict lines_go_both_ways(StreamSocketWorld& world) {
  if (!connected(world)) return Verdict::failed;
  const SocketSession session = world.socket().sessions()[0];
  Lines lines;
  if (!world.socket().write_line(session, "hello") || !world.socket().write(session, "two\nthr")) {
    return Verdict::failed;
  }
  if (!until(world, [&] { return world.got(0) == "hello\ntwo\nthr"; })) return Verdict::failed;
  if (!world.give(0, "one\r\n\ntw") || !hears(world, session, lines, 2)) return Verdict::failed;
  if (!world.give(0, "o\n") || !hears(world, session, lines, 3)) return Verdict::failed;
  return verdict(lines == Lines{"one", "", "two"} && world.feedback().received_bytes == 10 &&
                 world.feedback().sent_bytes == 13 && world.feedback().trouble_view().empty());
}

// [stream-socket-14]
Verdict lines_stay_until_the_cycle_ends(StreamSocketWorld& world) {
  if (!connected(world)) return Verdict::failed;
  const SocketSession session = world.socket().sessions()[0];
  if (!world.give(0, "one\ntwenty\nthree\n")) return Verdict::failed;
  if (!until(world, [&] { return world.socket().peek(session).size() == 17; })) return Verdict::failed;
  world.receive();
  std::vector<std::string_view> lines;
  while (const auto line = world.socket().read_line(session)) lines.push_back(*line);
  static_cast<void>(world.socket().write_line(session, "something of its own"));
  return verdict(lines == std::vector<std::string_view>{"one", "twenty", "three"});
}

// [stream-socket-9] [stream-socket-15]
Verdict bytes_are_taken_as_many_as_are_wanted(StreamSocketWorld& world) {
  if (!connected(world)) return Verdict::failed;
  const SocketSession session = world.socket().sessions()[0];
  if (!world.give(0, std::string_view("ab\0\ncd", 6))) return Verdict::failed;
  if (!until(world, [&] { return world.socket().peek(session).size() == 6; })) return Verdict::failed;
  world.socket().take(session, 3);
  world.receive();
  if (world.socket().peek(session) != "\ncd") return Verdict::failed;
  world.socket().take(session, 100);
  if (!world.socket().peek(session).empty() || !world.give(0, "new")) return Verdict::failed;
  return verdict(until(world, [&] { return world.socket().peek(session) == "new"; }));
}

Verdict a_peer_that_comes_later_is_found(StreamSocketWorld& world) {
  if (!world.start({})) return Verdict::failed;
  if (!until(world, [&] { return !world.feedback().trouble_view().empty(); })) return Verdict::failed;
  world.listen(true);
  const std::optional<Time> since = world.now();
  return verdict(has(world, 1) && is_in_time(world, since, "nobody at the address") &&
                 world.feedback().trouble_view().empty());
}

// [stream-socket-1] [stream-socket-5]
Verdict a_peer_that_ended_is_connected_to_again(StreamSocketWorld& world) {
  if (!connected(world)) return Verdict::failed;
  const SocketSession first = world.socket().sessions()[0];
  world.end(0);
  const std::optional<Time> since = world.now();
  if (!until(world, [&] { return world.connections() == 2 && world.socket().sessions().size() == 1; }) ||
      !is_in_time(world, since, "an end")) {
    return Verdict::failed;
  }
  const SocketSession second = world.socket().sessions()[0];
  return verdict(second != first && !world.socket().write_line(first, "late") &&
                 !world.socket().read_line(first) && world.socket().peek(first).empty() &&
                 world.socket().write_line(second, "new") &&
                 until(world, [&] { return world.got(1) == "new\n"; }) && world.feedback().opened == 2 &&
                 world.feedback().ended == 1 && world.feedback().refused_writes == 1);
}

Verdict a_connection_that_breaks_comes_again(StreamSocketWorld& world) {
  if (!connected(world)) return Verdict::failed;
  world.break_off(0);
  const std::optional<Time> since = world.now();
  return verdict(until(world, [&] { return world.connections() == 2; }) && has(world, 1) &&
                 is_in_time(world, since, "a connection reset") && world.feedback().ended == 1);
}

Verdict a_cable_that_is_in_again_connects_again(StreamSocketWorld& world) {
  if (!connected(world, {.peer_timeout = std::chrono::seconds(2)})) return Verdict::failed;
  if (!world.unplug()) return Verdict::skipped;
  if (!has(world, 0) || world.feedback().trouble_view().empty()) return Verdict::failed;
  world.plug_in();
  const std::optional<Time> since = world.now();
  return verdict(until(world, [&] { return world.connections() == 2; }) && has(world, 1) &&
                 is_in_time(world, since, "a cable out") && world.feedback().ended == 1 &&
                 world.feedback().trouble_view().empty());
}

// [stream-socket-3]
Verdict what_came_before_its_end_is_read(StreamSocketWorld& world) {
  if (!listening(world, {.listen = true}, 1)) return Verdict::failed;
  const SocketSession session = world.socket().sessions()[0];
  if (!world.give(0, "one\nrest")) return Verdict::failed;
  world.end(0);
  Lines lines;
  return verdict(hears(world, session, lines, 2) && lines == Lines{"one", "rest"} && has(world, 0));
}

// [stream-socket-11]
Verdict what_nobody_reads_does_not_keep_what_ended(StreamSocketWorld& world) {
  if (!listening(world, {.listen = true}, 1)) return Verdict::failed;
  const SocketSession session = world.socket().sessions()[0];
  if (!world.give(0, "rest\n")) return Verdict::failed;
  if (!until(world, [&] { return world.socket().peek(session) == "rest\n"; })) return Verdict::failed;
  world.end(0);
  return verdict(has(world, 0) && world.socket().peek(session).empty());
}

Verdict peers_are_told_apart(StreamSocketWorld& world) {
  if (!listening(world, {.listen = true, .sessions = 3}, 3)) return Verdict::failed;
  const std::span<const SocketSession> sessions = world.socket().sessions();
  const SocketSession ids[] = {sessions[0], sessions[1], sessions[2]};
  for (std::size_t i = 0; i < 3; ++i) {
    if (!world.give(i, "from " + std::to_string(i) + "\n")) return Verdict::failed;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    Lines lines;
    if (!hears(world, ids[i], lines, 1) || lines != Lines{"from " + std::to_string(i)})
      return Verdict::failed;
    if (!world.socket().write_line(ids[i], "to " + std::to_string(i))) return Verdict::failed;
  }
  return verdict(until(world, [&] {
    return world.got(0) == "to 0\n" && world.got(1) == "to 1\n" && world.got(2) == "to 2\n";
  }));
}

// [stream-socket-2]
Verdict one_peer_too_many_is_refused(StreamSocketWorld& world) {
  if (!listening(world, {.listen = true, .sessions = 2}, 2)) return Verdict::failed;
  const SocketSession second = world.socket().sessions()[1];
  world.connect();
  if (!until(world, [&] { return world.feedback().refused_sessions == 1 && world.is_ended(2); }))
    return Verdict::failed;
  world.end(0);
  if (!has(world, 1) || world.socket().sessions()[0] != second) return Verdict::failed;
  world.connect();
  return verdict(has(world, 2));
}

Verdict a_line_that_is_too_long_is_left_out(StreamSocketWorld& world) {
  if (!connected(world, {.buffer = 64})) return Verdict::failed;
  const SocketSession session = world.socket().sessions()[0];
  if (!world.give(0, "a\n" + std::string(1000, 'x') + "y\nb\n")) return Verdict::failed;
  Lines lines;
  return verdict(hears(world, session, lines, 2) && lines == Lines{"a", "b"} &&
                 world.feedback().long_lines == 1);
}

// [stream-socket-5]
Verdict who_does_not_read_holds_up_nobody_else(StreamSocketWorld& world) {
  if (!listening(world, {.listen = true, .sessions = 2, .buffer = 65536}, 2)) return Verdict::failed;
  const SocketSession slow = world.socket().sessions()[0];
  const SocketSession good = world.socket().sessions()[1];
  const std::string text(65000, 'x');
  // The kernel keeps some megabytes before it takes no more.
  if (!until(world, [&] { return !world.socket().write_line(slow, text); })) return Verdict::failed;
  if (!world.socket().write_line(good, "hello")) return Verdict::failed;
  return verdict(until(world, [&] { return world.got(1) == "hello\n"; }) &&
                 world.feedback().refused_writes >= 1 && world.socket().sessions().size() == 2);
}

// [stream-socket-7]
Verdict what_is_not_read_waits_and_is_not_lost(StreamSocketWorld& world) {
  if (!connected(world, {.buffer = 256})) return Verdict::failed;
  const SocketSession session = world.socket().sessions()[0];
  constexpr std::size_t count = 500;
  std::string all;
  for (std::size_t i = 0; i < count; ++i) all += "line " + std::to_string(i) + "\n";
  if (!world.give(0, all)) return Verdict::failed;
  for (int i = 0; i < 20; ++i) {
    world.receive();
    world.send();
  }
  Lines lines;
  if (!hears(world, session, lines, count) || lines.size() != count) return Verdict::failed;
  for (std::size_t i = 0; i < count; ++i) {
    if (lines[i] != "line " + std::to_string(i)) return Verdict::failed;
  }
  return Verdict::passed;
}

// [stream-socket-10]
Verdict what_was_written_is_sent_before_it_is_closed(StreamSocketWorld& world) {
  if (!listening(world, {.listen = true}, 1)) return Verdict::failed;
  const SocketSession session = world.socket().sessions()[0];
  if (!world.socket().write_line(session, "bye")) return Verdict::failed;
  world.socket().close(session);
  if (world.socket().write_line(session, "late")) return Verdict::failed;
  return verdict(until(world, [&] { return world.got(0) == "bye\n" && world.is_ended(0); }) && has(world, 0));
}

// [stream-socket-12]
Verdict who_does_not_read_is_closed_all_the_same(StreamSocketWorld& world) {
  if (!listening(world, {.listen = true, .buffer = 65536}, 1)) return Verdict::failed;
  const SocketSession session = world.socket().sessions()[0];
  const std::string text(65000, 'x');
  if (!until(world, [&] { return !world.socket().write_line(session, text); })) return Verdict::failed;
  world.socket().close(session);
  return verdict(has(world, 0));
}

// [stream-socket-13]
Verdict what_was_closed_is_connected_anew(StreamSocketWorld& world) {
  if (!connected(world)) return Verdict::failed;
  const SocketSession session = world.socket().sessions()[0];
  world.socket().close(session);
  return verdict(until(world, [&] { return world.connections() == 2; }) && has(world, 1) &&
                 world.socket().sessions()[0] != session);
}

// [stream-socket-8]
Verdict lines_go_to_the_queue_where_one_is_connected(StreamSocketWorld& world) {
  QueueBench<SocketLine, 4> queue;
  if (!world.start({.listen = true, .sessions = 2}, queue.sinks())) return Verdict::failed;
  world.connect();
  if (!has(world, 1)) return Verdict::failed;
  const SocketSession session = world.socket().sessions()[0];
  const std::string longest(sizeof(SocketLine::content), 'x');
  std::string all = longest + "y\n" + std::string("a\0b\n", 4);
  for (int i = 0; i < 10; ++i) all += "n\n";
  if (!world.give(0, all)) return Verdict::failed;
  Lines lines;
  const bool came = until(world, [&] {
    const auto line = queue.pop();
    if (line && line->session == session) {
      lines.emplace_back(std::string(line->content_view()) + (line->cut ? "~" : ""));
    }
    return lines.size() == 12;
  });
  return verdict(came && lines[0] == longest + "~" && lines[1] == "a?b" && lines[11] == "n" &&
                 queue.ring().counters().dropped == 0);
}

Verdict an_address_in_use_is_refused_with_its_cause(StreamSocketWorld& world) {
  if (!world.occupy()) return Verdict::skipped;
  const Status status = world.start({.listen = true});
  return verdict(status.code() == StatusCode::busy && status.cause()[0] != '\0');
}

// [stream-socket-1]
Verdict after_a_stop_it_begins_anew(StreamSocketWorld& world) {
  if (!connected(world)) return Verdict::failed;
  const SocketSession session = world.socket().sessions()[0];
  world.socket().stop();
  if (!world.socket().sessions().empty() || !sees_its_end(world, 0)) return Verdict::failed;
  if (!world.socket().initialise() || !has(world, 1)) return Verdict::failed;
  return verdict(world.socket().sessions()[0] != session);
}

template <Verdict (*Run)(StreamSocketWorld&)>
void judged(void**) {
  judge(make_world, Run);
}

}  // namespace

int run_stream_socket_conformance(const char* driver, MakeStreamSocketWorld make) {
  make_world = make;
#define CASE(name) \
  { #name, judged < name>, nullptr, nullptr, nullptr }
  const CMUnitTest tests[] = {
      CASE(lines_go_both_ways),
      CASE(lines_stay_until_the_cycle_ends),
      CASE(bytes_are_taken_as_many_as_are_wanted),
      CASE(a_peer_that_comes_later_is_found),
      CASE(a_peer_that_ended_is_connected_to_again),
      CASE(a_connection_that_breaks_comes_again),
      CASE(a_cable_that_is_in_again_connects_again),
      CASE(what_came_before_its_end_is_read),
      CASE(what_nobody_reads_does_not_keep_what_ended),
      CASE(peers_are_told_apart),
      CASE(one_peer_too_many_is_refused),
      CASE(a_line_that_is_too_long_is_left_out),
      CASE(who_does_not_read_holds_up_nobody_else),
      CASE(what_is_not_read_waits_and_is_not_lost),
      CASE(what_was_written_is_sent_before_it_is_closed),
      CASE(who_does_not_read_is_closed_all_the_same),
      CASE(what_was_closed_is_connected_anew),
      CASE(lines_go_to_the_queue_where_one_is_connected),
      CASE(an_address_in_use_is_refused_with_its_cause),
      CASE(after_a_stop_it_begins_anew),
  };
#undef CASE
  return cmocka_run_group_tests_name(driver, tests, nullptr, nullptr);
}

}  // namespace flexrf
