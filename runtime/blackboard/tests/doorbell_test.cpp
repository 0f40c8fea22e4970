#include "runtime/blackboard/doorbell.hpp"

#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <thread>

#include "tests/cmocka.hpp"

namespace flexrf {
namespace {

constexpr Time for_ever = Time::max();

// [board-36]
void a_ring_after_listening_ends_the_wait_at_once(void**) {
  Doorbell bell;
  const std::uint32_t heard = bell.listen();
  bell.ring();
  assert_true(bell.wait(heard, for_ever));
}

void without_a_ring_the_deadline_ends_the_wait(void**) {
  Doorbell bell;
  bell.ring();
  const std::uint32_t heard = bell.listen();
  const Time deadline = MonotonicClock::now() + std::chrono::milliseconds{5};
  assert_false(bell.wait(heard, deadline));
  assert_true(MonotonicClock::now() >= deadline);
  assert_false(bell.wait(heard, Time{}));
  assert_false(bell.wait(heard, Time{Duration{-5}}));
}

void a_sleeper_is_woken(void**) {
  static Doorbell bell;
  static std::atomic<bool> woken{false};
  const std::uint32_t heard = bell.listen();
  std::thread sleeper{[heard] { woken = bell.wait(heard, for_ever); }};
  usleep(5000);
  bell.ring();
  sleeper.join();
  assert_true(woken);
}

void the_count_wraps_around(void**) {
  Doorbell bell;
  bell.start_count_at(0x7FFFFFFF);
  const std::uint32_t heard = bell.listen();
  bell.ring();
  assert_int_equal(bell.listen(), 0);
  assert_true(bell.wait(heard, for_ever));
  assert_false(bell.wait(bell.listen(), Time{}));
}

Doorbell* rung_by_signal = nullptr;

// [board-37]
void a_signal_handler_may_ring_and_leaves_errno(void**) {
  static Doorbell bell;
  rung_by_signal = &bell;
  struct sigaction action {};
  action.sa_handler = [](int) { rung_by_signal->ring(); };
  assert_int_equal(sigaction(SIGUSR1, &action, nullptr), 0);
  const int descriptor = eventfd(0, EFD_NONBLOCK);
  eventfd_write(descriptor, 0xFFFFFFFFFFFFFFFE);  // the next write fails
  bell.use_descriptor(descriptor);
  assert_true(bell.announce(bell.listen()));
  errno = 77;
  assert_int_equal(std::raise(SIGUSR1), 0);
  assert_int_equal(errno, 77);
  bell.settle();
  close(descriptor);
}

bool is_readable(int descriptor) {
  pollfd look{descriptor, POLLIN, 0};
  return poll(&look, 1, 0) == 1;
}

// [board-38]
void descriptor_mode_writes_only_to_a_sleeper(void**) {
  Doorbell bell;
  const int descriptor = eventfd(0, EFD_NONBLOCK);
  bell.use_descriptor(descriptor);
  std::uint32_t heard = bell.listen();
  bell.ring();
  assert_false(is_readable(descriptor));
  assert_false(bell.announce(heard));
  heard = bell.listen();
  assert_true(bell.announce(heard));
  bell.ring();
  bell.ring();
  assert_true(is_readable(descriptor));
  bell.settle();
  assert_false(is_readable(descriptor));
  assert_int_not_equal(bell.listen(), heard);
  bell.ring();
  assert_false(is_readable(descriptor));
  close(descriptor);
}

}  // namespace
}  // namespace flexrf

int main() {
  using namespace flexrf;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_ring_after_listening_ends_the_wait_at_once),
      cmocka_unit_test(without_a_ring_the_deadline_ends_the_wait),
      cmocka_unit_test(a_sleeper_is_woken),
      cmocka_unit_test(the_count_wraps_around),
      cmocka_unit_test(a_signal_handler_may_ring_and_leaves_errno),
      cmocka_unit_test(descriptor_mode_writes_only_to_a_sleeper),
  };
  return cmocka_run_group_tests_name("doorbell", tests, nullptr, nullptr);
}
