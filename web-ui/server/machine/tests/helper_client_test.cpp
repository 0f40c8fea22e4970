// The client of the PC's helper, against helpers of every kind.
#include "web-ui/server/machine/helper_client.hpp"

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <atomic>
#include <memory>

#include "runtime/executive/tests/checks.hpp"
#include "runtime/executive/tests/running_cell.hpp"
#include "web-ui/server/machine/tests/played_helper.hpp"

namespace flexrf::panel {
namespace {

using How = PlayedHelper::How;
using Reaction = PlayedHelper::Reaction;

constexpr Duration patient = std::chrono::minutes{1};
constexpr Duration soon = std::chrono::milliseconds{150};

Reaction echo(const std::string& line, const std::string& bytes) {
  return {How::answers, line + "+" + std::to_string(bytes.size())};
}

struct World {
  explicit World(const SocketPlace& at) : client(at.path(), nullptr) { CHECK(client.start().is_ok()); }
  HelperClient::Answer next() {
    std::optional<HelperClient::Answer> answer;
    CHECK(test::wait_until([&] { return (answer = client.pop()).has_value(); }));
    return *answer;
  }
  HelperClient::Answer ask(const std::string& message, Duration patience = patient, bool repeatable = false) {
    const std::uint64_t number = client.ask(message, patience, repeatable);
    CHECK(number != 0);
    HelperClient::Answer answer = next();
    CHECK_EQUAL(answer.number, number);
    return answer;
  }
  HelperClient client;
};

void each_request_has_its_answer() {
  const SocketPlace place;
  const PlayedHelper helper(place.path(), echo);
  World world(place);
  CHECK_EQUAL(world.ask("a").text, "a+0");
  const std::string part(HelperClient::longest_part, '\n');
  CHECK_EQUAL(world.ask("b\n" + part).text, "b+" + std::to_string(part.size()));
  const std::uint64_t first = world.client.ask("c", patient, false);
  const std::uint64_t second = world.client.ask("d", patient, false);
  CHECK_EQUAL(world.next().number, first);
  const HelperClient::Answer answer = world.next();
  CHECK_EQUAL(answer.number, second);
  CHECK_EQUAL(answer.text, "d+0");
}

void no_helper_is_told_at_once() {
  const SocketPlace place;
  World world(place);
  const HelperClient::Answer answer = world.ask("a");
  CHECK(answer.status.code() == StatusCode::unavailable);
  CHECK_CONTAINS(answer.status.cause(), "the PC's helper is not there");
  CHECK_CONTAINS(answer.status.cause(), "No such file or directory");
  CHECK_CONTAINS(answer.status.cause(), "restart the PC");
  // It comes later, as after a restart of its service.
  const PlayedHelper helper(place.path(), echo);
  CHECK_EQUAL(world.ask("b").text, "b+0");
}

void a_helper_that_was_started_anew_is_found_again() {
  const SocketPlace place;
  auto helper = std::make_unique<PlayedHelper>(place.path(), echo);
  World world(place);
  CHECK_EQUAL(world.ask("a").text, "a+0");
  helper.reset();
  helper = std::make_unique<PlayedHelper>(place.path(), echo);
  CHECK_EQUAL(world.ask("b").text, "b+0");
  helper.reset();
  CHECK(!world.ask("c").status.is_ok());
}

void what_may_have_been_done_is_not_done_again() {
  const SocketPlace place;
  std::atomic<int> times{0};
  const PlayedHelper helper(place.path(), [&times](const std::string& line, const std::string&) -> Reaction {
    return ++times % 2 == 1 ? Reaction{How::hangs_up, ""} : Reaction{How::answers, line};
  });
  World world(place);
  const HelperClient::Answer answer = world.ask("install");
  CHECK(answer.status.code() == StatusCode::unavailable);
  CHECK_CONTAINS(answer.status.cause(), "ended before it answered");
  CHECK_EQUAL(times.load(), 1);
  times = 0;
  CHECK_EQUAL(world.ask("state", patient, true).text, "state");
  CHECK_EQUAL(times.load(), 2);
}

void a_helper_that_always_hangs_up_is_not_asked_for_ever() {
  const SocketPlace place;
  std::atomic<int> times{0};
  const PlayedHelper helper(place.path(), [&times](const std::string&, const std::string&) -> Reaction {
    ++times;
    return {How::hangs_up, ""};
  });
  World world(place);
  CHECK(!world.ask("state", patient, true).status.is_ok());
  CHECK_EQUAL(times.load(), 2);
}

void silence_has_an_end_and_a_late_answer_is_nobodys() {
  const SocketPlace place;
  std::atomic<bool> is_slow{true};
  const PlayedHelper helper(place.path(),
                            [&is_slow](const std::string& line, const std::string&) -> Reaction {
                              if (is_slow) std::this_thread::sleep_for(3 * soon);
                              return {How::answers, line};
                            });
  World world(place);
  const Time begun = MonotonicClock::now();
  const HelperClient::Answer answer = world.ask("a", soon);
  CHECK(answer.status.code() == StatusCode::timeout);
  CHECK_CONTAINS(answer.status.cause(), "does not answer");
  CHECK(MonotonicClock::now() - begun >= soon);
  is_slow = false;
  CHECK_EQUAL(world.ask("b").text, "b");
}

void a_helper_that_takes_no_connection_is_told() {
  const SocketPlace place;
  const int listener = socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  place.path().copy(address.sun_path, sizeof(address.sun_path) - 1);
  const auto* const where = reinterpret_cast<const sockaddr*>(&address);
  CHECK(bind(listener, where, sizeof(address)) == 0 && listen(listener, 0) == 0);
  // All that may wait.
  const int other = socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0);
  CHECK(connect(other, where, sizeof(address)) == 0);
  World world(place);
  CHECK(world.ask("a", soon).status.code() == StatusCode::timeout);
  close(other);
  close(listener);
}

void a_word_too_many_is_no_answer_to_the_next() {
  const SocketPlace place;
  std::atomic<int> answered{0};
  const PlayedHelper helper(place.path(), [&](const std::string& line, const std::string&) -> Reaction {
    return {++answered == 1 ? How::answers_twice : How::answers, line};
  });
  World world(place);
  CHECK_EQUAL(world.ask("a").text, "a");
  CHECK(test::wait_until([&] { return helper.unasked_words() == 1; }));
  CHECK_EQUAL(world.ask("b").text, "b");
}

void an_answer_that_is_too_long_is_none() {
  const SocketPlace place;
  std::atomic<bool> is_long{true};
  const PlayedHelper helper(place.path(), [&](const std::string& line, const std::string&) -> Reaction {
    return {How::answers, is_long ? std::string(HelperClient::longest_answer + 1, 'x') : line};
  });
  World world(place);
  CHECK(world.ask("a").status.code() == StatusCode::out_of_range);
  is_long = false;
  CHECK_EQUAL(world.ask("b").text, "b");
}

void eight_may_wait_and_the_end_waits_for_none() {
  const SocketPlace place;
  const PlayedHelper helper(place.path(), [](const std::string&, const std::string&) {
    return Reaction{How::says_nothing, ""};
  });
  World world(place);
  for (std::size_t i = 0; i < HelperClient::places; ++i) CHECK(world.client.ask("a", patient, false) != 0);
  CHECK_EQUAL(world.client.ask("a", patient, false), 0U);
  const Time begun = MonotonicClock::now();
  world.client.stop();
  CHECK(MonotonicClock::now() - begun < patient / 2);
}

void a_path_that_no_socket_can_have_is_refused() {
  HelperClient client("/run/" + std::string(200, 'x'), nullptr);
  CHECK_CONTAINS(client.start().cause(), "--helper");
}

}  // namespace
}  // namespace flexrf::panel

int main() {
  using namespace flexrf::panel;
  const CMUnitTest tests[] = {
      CONTAINED_TEST(each_request_has_its_answer),
      CONTAINED_TEST(no_helper_is_told_at_once),
      CONTAINED_TEST(a_helper_that_was_started_anew_is_found_again),
      CONTAINED_TEST(what_may_have_been_done_is_not_done_again),
      CONTAINED_TEST(a_helper_that_always_hangs_up_is_not_asked_for_ever),
      CONTAINED_TEST(silence_has_an_end_and_a_late_answer_is_nobodys),
      CONTAINED_TEST(a_helper_that_takes_no_connection_is_told),
      CONTAINED_TEST(a_word_too_many_is_no_answer_to_the_next),
      CONTAINED_TEST(an_answer_that_is_too_long_is_none),
      CONTAINED_TEST(eight_may_wait_and_the_end_waits_for_none),
      CONTAINED_TEST(a_path_that_no_socket_can_have_is_refused),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
