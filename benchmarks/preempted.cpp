// What one side of a slot takes while the other is preempted in the middle of its access, against a memcpy in
// the same place.
//
// Both sides share one CPU. The victim copies all the time; the measured side has a higher priority, wakes up
// now and then, does one operation, and sleeps again. Only cycles count in which the victim was inside its
// access.
#include <atomic>
#include <ctime>
#include <memory>
#include <thread>

#include "benchmarks/harness.hpp"
#include "runtime/blackboard/ports.hpp"
#include "runtime/blackboard/test_types.hpp"

namespace flexrf::bench {
namespace {

using namespace std::chrono_literals;
using Item = test::Block<128>;

constexpr int cpu = 0;

/// Nanoseconds where it can be had cheaply; only ratios are judged.
std::uint64_t ticks() {
#if defined(__x86_64__)
  __builtin_ia32_lfence();
  const std::uint64_t now = __builtin_ia32_rdtsc();
  __builtin_ia32_lfence();
  return now;
#else
  return static_cast<std::uint64_t>(nanoseconds(MonotonicClock::now()));
#endif
}

struct Sample {
  std::vector<double> values;
  std::uint64_t cycles = 0;
};

/// Runs `operation` every 100 us above a victim that repeats `access`, which sets `inside` while it is in it.
template <class Operation, class Access>
Sample measure(std::uint64_t cycles, Operation&& operation, Access&& access) {
  std::atomic<bool> inside{false};
  std::atomic<bool> done{false};
  std::thread victim{[&] {
    leave_real_time();
    while (!done.load(std::memory_order_relaxed)) access(inside);
  }};
  Sample sample;
  sample.values.reserve(cycles);
  const timespec pause{0, 100'000};
  for (; sample.cycles < cycles; ++sample.cycles) {
    clock_nanosleep(CLOCK_MONOTONIC, 0, &pause, nullptr);
    const bool counts = inside.load(std::memory_order_relaxed);
    const std::uint64_t begin = ticks();
    operation();
    const std::uint64_t end = ticks();
    if (counts) sample.values.push_back(static_cast<double>(end - begin));
  }
  done = true;
  victim.join();
  return sample;
}

struct Board {
  Board() { output.connect(&context, &slot.control()); }
  Slot<Item, 1> slot;
  SlotReader reader{&slot.control()};
  StepContext context{1, Time{Duration{1}}};
  Output<Item> output;
  alignas(cache_line) Item in{};
  alignas(cache_line) Item out{};
  struct alignas(cache_line) Buffer {
    Item value;
  };
  Buffer buffers[3]{};
  std::atomic<std::uint32_t> next{0};
};

void read_slot(Board& board, Item& out) {
  if (board.reader.newest() != nullptr) copy_item<Item>(&out, board.reader.payload());
  touch(&out);
}

Sample measure_writer(Board& board, std::uint64_t cycles) {
  Item copy{};
  return measure(
      cycles, [&board] { board.output.publish(board.in); },
      [&board, &copy](std::atomic<bool>& inside) {
        inside.store(true, std::memory_order_relaxed);
        read_slot(board, copy);
        inside.store(false, std::memory_order_relaxed);
      });
}

Sample measure_reader(Board& board, std::uint64_t cycles) {
  return measure(
      cycles, [&board] { read_slot(board, board.out); },
      [&board](std::atomic<bool>& inside) {
        const std::uint8_t buffer = board.slot.control().loan();
        inside.store(true, std::memory_order_relaxed);
        copy_item<Item>(board.slot.control().payload(buffer), &board.in);
        touch(board.slot.control().payload(buffer));
        inside.store(false, std::memory_order_relaxed);
        board.slot.control().publish(buffer, Time{Duration{1}});
      });
}

/// The same places without a slot: copies into (or out of) rotating buffers above one that copies out of (or
/// into) them.
Sample measure_copies(Board& board, std::uint64_t cycles, bool inwards) {
  Item copy{};
  std::uint32_t mine = 0;
  return measure(
      cycles,
      [&board, &mine, inwards] {
        mine = mine == 2 ? 0 : mine + 1;
        void* buffer = &board.buffers[mine].value;
        copy_item<Item>(inwards ? buffer : &board.out, inwards ? &board.in : buffer);
        touch(buffer);
      },
      [&board, &copy, &mine, inwards](std::atomic<bool>& inside) {
        inside.store(true, std::memory_order_relaxed);
        void* buffer = &board.buffers[mine == 0 ? 2 : mine - 1].value;
        copy_item<Item>(inwards ? &copy : buffer, inwards ? buffer : &board.in);
        touch(&copy);
        inside.store(false, std::memory_order_relaxed);
      });
}

int run(int argument_count, char** arguments) {
  Report report{"preempted", argument_count, arguments};
  const bool settled = settle_thread(cpu, 50);
  const std::uint64_t cycles = report.choose<std::uint64_t>(10'000, 1000);
  const int blocks = report.choose(20, 6);
  const auto board = std::make_unique<Board>();
  for (const bool writer : {true, false}) {
    std::uint64_t counted = 0;
    std::uint64_t all = 0;
    const Pairs pairs = alternate(
        blocks,
        [&] {
          Sample sample = writer ? measure_writer(*board, cycles) : measure_reader(*board, cycles);
          counted += sample.values.size();
          all += sample.cycles;
          return quantile(sample.values, 0.999);
        },
        [&] {
          Sample sample = measure_copies(*board, cycles, writer);
          return quantile(sample.values, 0.999);
        });
    report.add_ratio(
        text("p99.9 of %s, the other preempted in mid-access", writer ? "publish" : "latest"), pairs, 2,
        "ticks",
        text("1 KiB, %llu of %llu cycles counted%s", static_cast<unsigned long long>(counted),
             static_cast<unsigned long long>(all), settled ? "" : ", without real-time priorities"));
  }
  return report.finish();
}

}  // namespace
}  // namespace flexrf::bench

int main(int argument_count, char** arguments) {
  return flexrf::bench::run(argument_count, arguments);
}
