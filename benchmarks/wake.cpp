// From publishing to the woken reader at 1 kHz, against a raw futex wake.
#include <linux/futex.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <ctime>
#include <thread>

#include "benchmarks/harness.hpp"
#include "runtime/blackboard/ports.hpp"
#include "runtime/blackboard/test_types.hpp"

namespace flexrf::bench {
namespace {

using namespace std::chrono_literals;
using Item = test::Block<8>;

constexpr int priority = 60;

int processors() {
  return static_cast<int>(std::thread::hardware_concurrency());
}

void sleep_until(Time time) {
  timespec until{};
  until.tv_sec = static_cast<time_t>(nanoseconds(time) / 1'000'000'000);
  until.tv_nsec = static_cast<long>(nanoseconds(time) % 1'000'000'000);
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) != 0) {
  }
}

/// p50 and p99 of one block, in microseconds.
struct Latency {
  double p50;
  double p99;
};

/// Publishes at 1 kHz for `count` times by `publish(time)`; `await()` blocks until the next item and returns
/// its time, or Time{} after the last.
template <class Publish, class Await>
Latency measure(std::uint64_t count, Publish&& publish, Await&& await) {
  std::vector<double> latencies;
  latencies.reserve(count);
  std::thread reader{[&] {
    settle_thread(0, priority);
    for (;;) {
      const Time published_at = await();
      const Time now = MonotonicClock::now();
      if (published_at == Time{}) return;
      latencies.push_back(static_cast<double>((now - published_at).count()) * 1e-3);
    }
  }};
  Time next = MonotonicClock::now() + 5ms;
  for (std::uint64_t i = 0; i < count; ++i, next += 1ms) {
    sleep_until(next);
    publish(MonotonicClock::now());
  }
  sleep_until(next);
  publish(Time{});
  reader.join();
  return {quantile(latencies, 0.5), quantile(latencies, 0.99)};
}

Latency measure_blackboard(std::uint64_t count) {
  Doorbell bell;
  Doorbell* const bells[] = {&bell};
  Slot<Item, 1> slot{bells};
  SlotReader reader{&slot.control()};
  StepContext context{1, {}};
  Output<Item> output;
  output.connect(&context, &slot.control());
  std::uint64_t seen = 0;
  return measure(
      count, [&](Time now) { output.publish(Item{}, now); },
      [&] {
        for (;;) {
          const std::uint32_t heard = bell.listen();
          const ItemHeader* header = reader.newest();
          if (header != nullptr && header->sequence != seen) {
            seen = header->sequence;
            return header->sampled_at;
          }
          bell.wait(heard, Time::max());
        }
      });
}

Latency measure_futex(std::uint64_t count) {
  std::atomic<std::uint32_t> word{0};
  std::atomic<std::int64_t> published_at{0};
  std::uint32_t seen = 0;
  return measure(
      count,
      [&](Time now) {
        published_at.store(nanoseconds(now), std::memory_order_relaxed);
        word.fetch_add(1, std::memory_order_release);
        syscall(SYS_futex, &word, FUTEX_WAKE_PRIVATE, 1, nullptr, nullptr, 0);
      },
      [&] {
        while (word.load(std::memory_order_acquire) == seen) {
          syscall(SYS_futex, &word, FUTEX_WAIT_PRIVATE, seen, nullptr, nullptr, 0);
        }
        seen = word.load(std::memory_order_acquire);
        return Time{Duration{published_at.load(std::memory_order_relaxed)}};
      });
}

int run(int argument_count, char** arguments) {
  Report report{"wake", argument_count, arguments};
  settle_thread(1 % processors(), priority);
  const std::uint64_t count = report.choose<std::uint64_t>(10'000, 300);
  Pairs p50;
  Pairs p99;
  for (int block = 0; block < 20; ++block) {
    const bool ours_first = block % 2 == 0;
    const Latency first = ours_first ? measure_blackboard(count) : measure_futex(count);
    const Latency second = ours_first ? measure_futex(count) : measure_blackboard(count);
    const Latency& ours = ours_first ? first : second;
    const Latency& floor = ours_first ? second : first;
    p50.add(ours.p50, floor.p50);
    p99.add(ours.p99, floor.p99);
  }
  const std::string conditions = text("20 blocks of %.1f s each, 1 kHz", static_cast<double>(count) * 1e-3);
  report.add_ratio("publish to woken reader, p50", p50, 1.05, "us", conditions);
  report.add_ratio("publish to woken reader, p99", p99, 1.2, "us", conditions);
  return report.finish();
}

}  // namespace
}  // namespace flexrf::bench

int main(int argument_count, char** arguments) {
  return flexrf::bench::run(argument_count, arguments);
}
