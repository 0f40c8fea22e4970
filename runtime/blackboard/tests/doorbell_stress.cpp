// Sleepers and ringers at full rate: no wake-up is lost. A lost one leaves the sleeper asleep until a
// deadline that is far longer than any delay of a loaded machine.
#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <vector>

#include "runtime/blackboard/doorbell.hpp"
#include "runtime/blackboard/stress.hpp"
#include "tests/cmocka.hpp"

namespace flexrf {
namespace {

using test::Complaint;

constexpr std::chrono::seconds too_long{30};

/// Sleeps until rung. False when it slept for too long.
bool sleep_on(Doorbell& bell, std::uint32_t heard, int descriptor) {
  if (descriptor < 0) return bell.wait(heard, MonotonicClock::now() + too_long);
  if (!bell.announce(heard)) return true;
  pollfd look{descriptor, POLLIN, 0};
  const bool rung = poll(&look, 1, std::chrono::milliseconds{too_long}.count()) == 1;
  bell.settle();
  return rung;
}

/// Waits for `items` to pass `seen`, as a thread with a trigger does.
std::uint64_t next_items(const std::atomic<std::uint64_t>& items, std::uint64_t seen, Doorbell& bell,
                         int descriptor, Complaint& complaint) {
  for (;;) {
    const std::uint32_t heard = bell.listen();
    const std::uint64_t now = items.load(std::memory_order_acquire);
    if (now != seen) return now;
    if (!sleep_on(bell, heard, descriptor)) {
      complaint.make("lost wake-up");
      return items;
    }
  }
}

const char* run_ping_pong(bool with_descriptor) {
  const int descriptor = with_descriptor ? eventfd(0, EFD_NONBLOCK) : -1;
  Doorbell there;
  Doorbell back;
  there.use_descriptor(descriptor);
  std::atomic<std::uint64_t> balls{0};
  std::atomic<std::uint64_t> returned{0};
  Complaint complaint;
  const std::uint64_t count = test::items(20'000);
  std::thread partner{[&] {
    for (std::uint64_t seen = 0; seen < count;) {
      seen = next_items(balls, seen, there, descriptor, complaint);
      returned.store(seen, std::memory_order_release);
      back.ring();
    }
  }};
  for (std::uint64_t ball = 1; ball <= count; ++ball) {
    balls.store(ball, std::memory_order_release);
    there.ring();
    for (std::uint64_t seen = ball - 1; seen < ball;) seen = next_items(returned, seen, back, -1, complaint);
  }
  partner.join();
  if (descriptor >= 0) close(descriptor);
  return complaint.text();
}

/// Several ringers that do not wait for the sleeper: after the last ring it must have seen all.
const char* run_many_ringers() {
  constexpr std::uint64_t ringers = 3;
  Doorbell bell;
  bell.start_count_at(0x7FFFFF00);
  std::atomic<std::uint64_t> items{0};
  Complaint complaint;
  const std::uint64_t count = test::items(40'000);
  std::vector<std::thread> threads;
  for (std::uint64_t i = 0; i < ringers; ++i) {
    threads.emplace_back([&, i] {
      for (std::uint64_t number = 0; number < count; ++number) {
        items.fetch_add(1, std::memory_order_release);
        bell.ring();
        // Gaps, so that the sleeper does fall asleep.
        if (number % (8 + i) == 0) std::this_thread::sleep_for(std::chrono::microseconds{10});
      }
    });
  }
  for (std::uint64_t seen = 0; seen < ringers * count && complaint.text() == nullptr;) {
    seen = next_items(items, seen, bell, -1, complaint);
  }
  for (std::thread& thread : threads) thread.join();
  return complaint.text();
}

// [board-36] [board-38]
void no_wake_up_is_lost(void**) {
  const char* const complaints[] = {run_ping_pong(false), run_ping_pong(true), run_many_ringers()};
  for (const char* complaint : complaints) {
    if (complaint != nullptr) fail_msg("%s", complaint);
  }
}

}  // namespace
}  // namespace flexrf

int main() {
  using namespace flexrf;
  const CMUnitTest tests[] = {cmocka_unit_test(no_wake_up_is_lost)};
  return cmocka_run_group_tests_name("doorbell stress", tests, nullptr, nullptr);
}
