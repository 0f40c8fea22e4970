// What publishing and reading cost: by value against memcpy, in place in nanoseconds, across cores, and
// whether anything was ever torn.
#include <array>
#include <atomic>
#include <memory>
#include <thread>

#include "benchmarks/harness.hpp"
#include "runtime/blackboard/ports.hpp"
#include "runtime/blackboard/test_types.hpp"

namespace flexrf::bench {
namespace {

using test::Block;
using namespace std::chrono_literals;

int processors() {
  return static_cast<int>(std::thread::hardware_concurrency());
}

constexpr int blocks = 200;
constexpr Duration block_length = 200us;

/// One writing and one reading unit in one thread.
template <class T>
struct Pair {
  Pair() {
    output.connect(&context, &slot.control());
    input.connect(&context, InputBinding{&reader, 1, {}, nullptr});
  }
  void publish_and_read() {
    touch(&in);
    ++context.step;
    output.publish(in);
    input.latest().copy_to(out);
    touch(&out);
  }
  Slot<T, 1> slot;
  SlotReader reader{&slot.control()};
  StepContext context{1, Time{Duration{1}}};
  Output<T> output;
  Input<T> input;
  alignas(cache_line) T in{};
  alignas(cache_line) T out{};
};

/// What a copy in and a copy out cost in as many rotating buffers as the slot has.
template <class T>
struct Copies {
  /// As the compiler expands a memcpy of known size.
  void copy_in_and_out() {
    touch(&in);
    std::memcpy(&buffers[next].value, &in, sizeof(T));
    touch(buffers);
    std::memcpy(&out, &buffers[next].value, sizeof(T));
    touch(&out);
    next = next == 2 ? 0 : next + 1;
  }
  /// As the slot's ports copy: by the C library where that is faster.
  void copy_as_ports_do() {
    touch(&in);
    copy_item<T>(&buffers[next].value, &in);
    touch(buffers);
    copy_item<T>(&out, &buffers[next].value);
    touch(&out);
    next = next == 2 ? 0 : next + 1;
  }
  struct alignas(sizeof(T) < large_payload ? cache_line : page) Buffer {
    T value;
  };
  Buffer buffers[3]{};
  alignas(cache_line) T in{};
  alignas(cache_line) T out{};
  std::size_t next = 0;
};

template <std::size_t Words>
void measure_by_value(Report& report, const char* size, double goal) {
  using T = Block<Words>;
  const auto pair = std::make_unique<Pair<T>>();
  const auto copies = std::make_unique<Copies<T>>();
  const auto ours = [&pair] { pair->publish_and_read(); };
  const auto floor = [&copies] { copies->copy_in_and_out(); };
  const std::uint64_t calls = calls_in(block_length, floor);
  const Pairs pairs = alternate(
      report.choose(blocks, 20), [&] { return nanoseconds_per_call(calls, ours); },
      [&] { return nanoseconds_per_call(calls, floor); });
  report.add_ratio(text("publish + read by value, %s", size), pairs, goal, "ns");
  if (Words != 128) return;
  const Pairs same_copy = alternate(
      report.choose(blocks, 20), [&] { return nanoseconds_per_call(calls, ours); },
      [&] { return nanoseconds_per_call(calls, [&copies] { copies->copy_as_ports_do(); }); });
  report.add({text("  the same against the C library's memcpy, %s", size), "", same_copy.ratio(), 0, false,
              text("floor %.2f ns", same_copy.floor().median)});
}

/// A slot and its readers in one thread, without anything but the slot.
template <std::size_t Readers, std::size_t Words>
struct InPlace {
  InPlace() {
    for (SlotReader& reader : readers) reader = SlotReader{&slot.control()};
  }
  void publish() {
    const std::uint8_t buffer = slot.control().loan();
    touch(slot.control().payload(buffer));
    slot.control().publish(buffer, Time{Duration{1}});
  }
  void view() {
    for (SlotReader& reader : readers) {
      reader.newest();
      touch(reader.payload());
    }
  }
  Slot<Block<Words>, Readers> slot;
  SlotReader readers[Readers];
};

/// Time per call in `count` kinds of calls, their blocks taking turns.
template <std::size_t Count, class Measure>
std::array<std::vector<double>, Count> take_turns(int rounds, Measure&& measure) {
  std::array<std::vector<double>, Count> result;
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t kind = 0; kind < Count; ++kind) result[kind].push_back(measure(kind));
  }
  return result;
}

void add_nanoseconds(Report& report, const std::string& what, const std::vector<double>& values, double goal,
                     double exchange, double load) {
  const Estimate value = estimate(values);
  report.add({what, "ns", value, goal, goal > 0,
              text("%.1f exchanges, %.1f loads", value.median / exchange, value.median / load)});
}

template <std::size_t Readers, std::size_t Words>
void measure_in_place(Report& report, const char* size) {
  const auto board = std::make_unique<InPlace<Readers, Words>>();
  std::atomic<std::uint64_t> word{0};
  constexpr std::uint64_t calls = 10'000;
  std::array<std::vector<double>, 5> all = take_turns<5>(report.choose(blocks, 20), [&](std::size_t kind) {
    switch (kind) {
      case 0:
        return nanoseconds_per_call(calls, [&] { word.exchange(1, std::memory_order_acq_rel); });
      case 1:
        return nanoseconds_per_call(calls, [&] { touch(reinterpret_cast<void*>(word.load())); });
      case 2:
        return nanoseconds_per_call(calls, [&] { board->publish(); });
      case 3:
        return nanoseconds_per_call(calls, [&] {
          board->publish();
          board->view();
        });
      default:
        return nanoseconds_per_call(calls, [&] { board->view(); });
    }
  });
  // A new view needs a publication, whose cost is taken off again, round by round.
  for (std::size_t i = 0; i < all[3].size(); ++i) all[3][i] = (all[3][i] - all[2][i]) / Readers;
  for (double& value : all[4]) value /= Readers;
  const double exchange = estimate(all[0]).median;
  const double load = estimate(all[1]).median;
  const std::string where = text("%s, %zu reader%s", size, Readers, Readers == 1 ? "" : "s");
  if (Readers == 1) {
    add_nanoseconds(report, text("one exchange (%s)", size), all[0], 0, exchange, load);
    add_nanoseconds(report, text("one atomic load (%s)", size), all[1], 0, exchange, load);
  }
  add_nanoseconds(report, "loan + publish, " + where, all[2], 8, exchange, load);
  add_nanoseconds(report, "new view, " + where, all[3], 13, exchange, load);
  add_nanoseconds(report, "old view, " + where, all[4], 1.5, exchange, load);
}

/// The same as a unit sees it: per-step latch, reasons, freshness, missed, age.
void measure_inputs(Report& report) {
  constexpr std::size_t count = 8;
  constexpr std::uint64_t calls = 5000;
  const auto board = std::make_unique<InPlace<count, 8>>();
  StepContext context{1, Time{Duration{1}}};
  Input<Block<8>> inputs[count];
  for (std::size_t i = 0; i < count; ++i) {
    inputs[i].connect(&context, InputBinding{&board->readers[i], 1, {}, nullptr});
  }
  const auto step = [&] {
    ++context.step;
    for (Input<Block<8>>& input : inputs) touch(&*input.latest());
  };
  std::array<std::vector<double>, 3> all = take_turns<3>(report.choose(blocks, 20), [&](std::size_t kind) {
    if (kind == 0) return nanoseconds_per_call(calls, [&] { board->publish(); });
    if (kind == 2) return nanoseconds_per_call(calls, step) / count;
    return nanoseconds_per_call(calls, [&] {
      board->publish();
      step();
    });
  });
  for (std::size_t i = 0; i < all[1].size(); ++i) all[1][i] = (all[1][i] - all[0][i]) / count;
  report.add(
      {"Input::latest(), new item", "ns", estimate(all[1]), 0, false, "8 readers, first call in a step"});
  report.add(
      {"Input::latest(), old item", "ns", estimate(all[2]), 0, false, "8 readers, first call in a step"});
}

/// Writer and readers on two cores at full rate, the readers in one thread.
template <std::size_t Readers>
void measure_across_cores(Report& report) {
  const auto board = std::make_unique<InPlace<Readers, 8>>();
  std::vector<double> publish;
  std::vector<double> view;
  for (int block = 0; block < report.choose(20, 4); ++block) {
    std::atomic<bool> ready{false};
    std::atomic<bool> done{false};
    std::thread other{[&] {
      settle_thread(0, 0);
      ready = true;
      std::uint64_t views = 0;
      const Time begin = MonotonicClock::now();
      while (!done) {
        board->view();
        ++views;
      }
      view.push_back(static_cast<double>((MonotonicClock::now() - begin).count()) /
                     static_cast<double>(views * Readers));
    }};
    while (!ready) std::this_thread::yield();
    publish.push_back(nanoseconds_per_call(report.choose(2'000'000U, 500'000U), [&] { board->publish(); }));
    done = true;
    other.join();
  }
  const char* plural = Readers == 1 ? "" : "s";
  report.add({text("across cores: loan + publish, %zu reader%s", Readers, plural), "ns", estimate(publish), 0,
              false, "both at full rate"});
  report.add({text("across cores: view, %zu reader%s", Readers, plural), "ns", estimate(view), 0, false,
              "both at full rate, new or old"});
}

/// From publishing on one core to having read on the other, both spinning: half a round trip.
void measure_round_trip(Report& report) {
  const auto there = std::make_unique<InPlace<1, 8>>();
  const auto back = std::make_unique<InPlace<1, 8>>();
  const auto wait_for = [](InPlace<1, 8>& board, std::uint64_t sequence) {
    for (;;) {
      const ItemHeader* header = board.readers[0].newest();
      if (header != nullptr && header->sequence >= sequence) return;
    }
  };
  const int rounds = report.choose(100, 10);
  constexpr std::uint64_t trips = 500;
  std::thread other{[&] {
    settle_thread(0, 0);
    for (std::uint64_t trip = 1; trip <= trips * static_cast<std::uint64_t>(rounds); ++trip) {
      wait_for(*there, trip);
      back->publish();
    }
  }};
  std::vector<double> values;
  std::uint64_t trip = 0;
  for (int round = 0; round < rounds; ++round) {
    values.push_back(nanoseconds_per_call(trips,
                                          [&] {
                                            there->publish();
                                            wait_for(*back, ++trip);
                                          }) /
                     2);
  }
  other.join();
  report.add(
      {"across cores: publish to read", "ns", estimate(values), 0, false, "both spin; half a round trip"});
}

template <std::size_t Readers>
void count_torn_reads(Report& report) {
  using T = Block<128>;
  const auto slot = std::make_unique<Slot<T, Readers>>();
  std::atomic<bool> done{false};
  std::atomic<std::uint64_t> bad{0};
  std::atomic<std::uint64_t> reads{0};
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < Readers; ++i) {
    threads.emplace_back([&, i] {
      settle_thread(static_cast<int>(i) % processors(), 0);
      SlotReader reader{&slot->control()};
      std::uint64_t last = 0;
      std::uint64_t mine = 0;
      while (!done) {
        const ItemHeader* header = reader.newest();
        if (header == nullptr || header->sequence == last) continue;
        const T& value = *static_cast<const T*>(reader.payload());
        const bool whole = value.is_whole() && value.words[0] == header->sequence;
        if (!whole || header->sequence < last) bad.fetch_add(1);
        last = header->sequence;
        ++mine;
      }
      reads.fetch_add(mine);
    });
  }
  const Duration length = report.choose<Duration>(10s, 1s);
  const Time end = MonotonicClock::now() + length;
  std::uint64_t sequence = 0;
  while (MonotonicClock::now() < end) {
    for (int i = 0; i < 100; ++i) {
      const std::uint8_t buffer = slot->control().loan();
      static_cast<T*>(static_cast<void*>(slot->control().payload(buffer)))->fill(++sequence);
      slot->control().publish(buffer, Time{Duration{1}});
    }
  }
  done = true;
  for (std::thread& thread : threads) thread.join();
  const auto count = static_cast<double>(bad.load());
  report.add(
      {text("torn or backward reads, %zu reader%s", Readers, Readers == 1 ? "" : "s"),
       "",
       {count, count, count},
       0,
       true,
       text("1 KiB, %.0f s, %llu published, %llu read", seconds(length),
            static_cast<unsigned long long>(sequence), static_cast<unsigned long long>(reads.load()))});
}

int run(int argument_count, char** arguments) {
  Report report{"blackboard", argument_count, arguments};
  settle_thread(1 % processors(), 50);
  measure_by_value<8>(report, "64 B", 6.2);
  measure_by_value<128>(report, "1 KiB", 1.10);
  measure_by_value<8192>(report, "64 KiB", 1.02);
  measure_by_value<131072>(report, "1 MiB", 1.05);
  measure_in_place<1, 8>(report, "64 B");
  measure_in_place<2, 8>(report, "64 B");
  measure_in_place<4, 8>(report, "64 B");
  measure_in_place<8, 8>(report, "64 B");
  measure_in_place<1, 131072>(report, "1 MiB");
  measure_in_place<8, 131072>(report, "1 MiB");
  measure_inputs(report);
  leave_real_time();
  measure_across_cores<1>(report);
  measure_across_cores<2>(report);
  measure_across_cores<4>(report);
  measure_across_cores<8>(report);
  measure_round_trip(report);
  count_torn_reads<1>(report);
  count_torn_reads<3>(report);
  return report.finish();
}

}  // namespace
}  // namespace flexrf::bench

int main(int argument_count, char** arguments) {
  return flexrf::bench::run(argument_count, arguments);
}
