// A driver's helper thread: when it works, how it ends, and what it is.
#include "hal/driver/helper_thread.hpp"

#include <pthread.h>
#include <sched.h>
#include <sys/eventfd.h>
#include <sys/resource.h>
#include <unistd.h>

#include <atomic>
#include <csignal>

#include "tests/cmocka.hpp"
#include "tests/waiting.hpp"

namespace flexrf {
namespace {

using std::chrono::milliseconds;

// Counts how often it was at work, and looks at its own thread.
struct Worker {
  void keep() {
    looked_at = look();
    do {
      ++rounds;
    } while (helper.wait(milliseconds{1}));
    ended = true;
  }
  void listen() {
    pollfd source{bell, POLLIN, 0};
    while (helper.wait(std::chrono::hours{1}, {&source, 1})) {
      eventfd_t count = 0;
      if (source.revents != 0 && eventfd_read(bell, &count) == 0) rounds += static_cast<int>(count);
    }
    ended = true;
  }
  void leave() { ++rounds; }

  static bool look() {
    sigset_t blocked;
    pthread_sigmask(SIG_SETMASK, nullptr, &blocked);
    pthread_attr_t attributes;
    std::size_t size = 0;
    if (pthread_getattr_np(pthread_self(), &attributes) != 0) return false;
    pthread_attr_getstacksize(&attributes, &size);
    pthread_attr_destroy(&attributes);
    char name[16];
    pthread_getname_np(pthread_self(), name, sizeof(name));
    return sigismember(&blocked, SIGTERM) == 1 && sigismember(&blocked, SIGINT) == 1 &&
           sigismember(&blocked, SIGSEGV) == 0 && sched_getscheduler(0) == SCHED_OTHER &&
           size < 8U * 1024 * 1024 && std::string_view(name) == "left_hand_camer";
  }
  bool until(int wanted) const {
    return test::wait_until([&] { return rounds >= wanted; });
  }

  HelperThread helper;
  int bell = eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
  std::atomic<int> rounds{0};
  std::atomic<bool> ended{false};
  std::atomic<bool> looked_at{false};
};

void it_works_until_it_is_ended(void**) {
  bool good = false;
  bool as_it_should_be = false;
  {
    Worker worker;
    good = worker.helper.begin<Worker, &Worker::keep>("left_hand_camera", worker).is_ok() && worker.until(5);
    worker.helper.end();
    const int rounds = worker.rounds;
    usleep(20'000);
    good = good && worker.ended && worker.rounds == rounds;
    as_it_should_be = worker.looked_at;
    close(worker.bell);
  }
  assert_true(good);
  assert_true(as_it_should_be);
}

void it_hears_what_it_watches_and_ends_at_once(void**) {
  bool heard = false;
  bool ended = false;
  {
    Worker worker;
    if (worker.helper.begin<Worker, &Worker::listen>("line", worker)) {
      eventfd_write(worker.bell, 3);
      heard = worker.until(3);
      worker.helper.end();  // or the test takes an hour
      ended = worker.ended;
    }
    close(worker.bell);
  }
  assert_true(heard);
  assert_true(ended);
}

void it_can_be_begun_again_but_not_twice(void**) {
  bool good = false;
  {
    Worker worker;
    const Status first = worker.helper.begin<Worker, &Worker::keep>("x", worker);
    const Status second = worker.helper.begin<Worker, &Worker::keep>("x", worker);
    worker.helper.end();
    worker.helper.end();  // nothing
    const bool is_over = worker.ended.exchange(false);
    const Status again = worker.helper.begin<Worker, &Worker::keep>("x", worker);
    worker.helper.end();
    good = first.is_ok() && second.code() == StatusCode::busy && is_over && again.is_ok() && worker.ended;
    close(worker.bell);
  }
  assert_true(good);
}

void work_that_returns_by_itself_can_be_ended(void**) {
  bool good = false;
  {
    Worker worker;
    good = worker.helper.begin<Worker, &Worker::leave>("x", worker).is_ok() && worker.until(1);
    worker.helper.end();
    close(worker.bell);
  }
  assert_true(good);
}

void where_there_is_no_descriptor_it_says_so(void**) {
  bool told = false;
  rlimit before{};
  getrlimit(RLIMIT_NOFILE, &before);
  {
    Worker worker;
    rlimit none = before;
    none.rlim_cur = 0;
    setrlimit(RLIMIT_NOFILE, &none);
    const Status status = worker.helper.begin<Worker, &Worker::leave>("arm", worker);
    setrlimit(RLIMIT_NOFILE, &before);
    told = status.code() == StatusCode::unavailable &&
           std::string_view(status.cause()).starts_with("no event descriptor") && worker.rounds == 0;
    close(worker.bell);
  }
  assert_true(told);
}

}  // namespace
}  // namespace flexrf

int main() {
  using namespace flexrf;
  const CMUnitTest tests[] = {
      cmocka_unit_test(it_works_until_it_is_ended),
      cmocka_unit_test(it_hears_what_it_watches_and_ends_at_once),
      cmocka_unit_test(it_can_be_begun_again_but_not_twice),
      cmocka_unit_test(work_that_returns_by_itself_can_be_ended),
      cmocka_unit_test(where_there_is_no_descriptor_it_says_so),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
