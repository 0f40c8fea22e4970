// What waits in a queue releases its reader, without a new arrival.
#include <algorithm>
#include <array>
#include <optional>

#include "runtime/executive/tests/running_cell.hpp"

namespace flexrf::fixture::waiting_test {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;
using Cell = ProducerAndConsumer;

constexpr Time beginning{std::chrono::seconds{1}};  // of virtual time
constexpr std::uint64_t burst_at = 3;               // step of the producer
constexpr Duration budget = microseconds{50};       // of each unit

/// A release of the consumer.
struct Seen {
  std::int64_t at;  ///< us since the beginning
  std::uint32_t fired;
  bool timed_out;
  bool took;
};

/// A cell whose producer pushes a burst in one step, every `every` steps, and nothing else; and whose
/// consumer takes one job in a step, if it is not resting.
class BurstCell : public Cell {
 public:
  explicit BurstCell(const TriggerPlan& trigger) {
    thread(consuming).trigger = trigger;
    unit(producer).script.step = [this](TestUnit& stepped, const Tick& tick) {
      if (tick.number < burst_at || tick.finishing) return;
      if (tick.number == burst_at || (every != 0 && (tick.number - burst_at) % every == 0)) {
        for (int i = 0; i < burst; ++i) stepped.orders.push(Item{});
      }
    };
    unit(consumer).script.step = [this](TestUnit& stepped, const Tick& tick) {
      if (tick.stop_requested) return;
      const bool took = tick.now >= rests_until && stepped.jobs.pop().has_value();
      seen.push_back({(tick.now - beginning).count() / 1000, tick.fired, tick.timed_out, took});
      mean = Duration{thread_state(consuming).backoff_mean.load()};
    };
  }

  void run(Duration duration) {
    Executive executive(application(), in_virtual_time(duration));
    CHECK_EQUAL(run_to_the_end(executive).exit_code, 0);
  }

  std::size_t taken() const {
    return static_cast<std::size_t>(std::ranges::count_if(seen, [](const Seen& one) { return one.took; }));
  }
  std::vector<std::int64_t> times() const {
    std::vector<std::int64_t> all;
    for (const Seen& one : seen) all.push_back(one.at);
    return all;
  }

  int burst = 5;
  std::uint64_t every = 0;
  Time rests_until{};
  std::vector<Seen> seen;
  Duration mean{};  ///< as back-off learned it
};

TriggerPlan on_jobs(Duration min_interval = {}, Duration timeout = {}) {
  TriggerPlan plan = TriggerPlan::on_slots({}, {Cell::jobs});
  plan.min_interval = min_interval;
  plan.timeout = timeout;
  return plan;
}

TriggerPlan backing_off_on_jobs(Duration shortest, Duration longest) {
  TriggerPlan plan = TriggerPlan::backing_off(Cell::values, shortest, longest);
  plan.slots = {};
  plan.queues = {Cell::jobs};
  return plan;
}

// [exec-16] [exec-86]
void a_burst_is_worked_off_one_by_one() {
  BurstCell cell(on_jobs());
  cell.run(milliseconds{50});
  // Step by step, each a budget long, from when the burst becomes visible; then there is nothing more to do.
  CHECK((cell.times() == std::vector<std::int64_t>{3050, 3100, 3150, 3200, 3250}));
  CHECK_EQUAL(cell.taken(), 5U);
  for (const Seen& one : cell.seen) CHECK(one.fired == 1 && !one.timed_out);
}

// [exec-9] [exec-86]
void a_burst_keeps_the_least_interval() {
  BurstCell cell(on_jobs(milliseconds{4}));
  cell.run(milliseconds{50});
  CHECK((cell.times() == std::vector<std::int64_t>{4000, 8000, 12'000, 16'000, 20'000}));
  CHECK_EQUAL(cell.taken(), 5U);
}

/// The queue is full soon, and takes no more: no arrival will ever release its reader.
// [exec-87]
void a_full_queue_is_offered_until_its_reader_takes() {
  BurstCell cell(on_jobs());
  cell.every = 1;
  cell.burst = 16;
  cell.rests_until = beginning + milliseconds{200};
  cell.run(milliseconds{300});
  std::vector<std::int64_t> pauses;
  std::int64_t longest = 0;
  for (std::size_t i = 1; i < cell.seen.size() && !cell.seen[i].took; ++i) {
    const std::int64_t pause = cell.seen[i].at - cell.seen[i - 1].at - budget.count() / 1000;
    if (i <= 6) pauses.push_back(pause);
    longest = std::max(longest, pause);
  }
  CHECK((pauses == std::vector<std::int64_t>{1000, 2000, 4000, 8000, 16'000, 16'000}));
  CHECK_EQUAL(longest, 16'000);
  const auto first = std::ranges::find_if(cell.seen, [](const Seen& one) { return one.took; });
  CHECK(first != cell.seen.end());
  CHECK(first->at >= 200'000 && first->at < 217'000);
  // From there on it takes whatever comes.
  CHECK(cell.taken() > 1000);
}

/// A pause is counted from the end of a step: one that takes long must not have its thread in circles.
// [exec-87]
void a_long_step_that_takes_nothing_rests_too() {
  BurstCell cell(on_jobs());
  cell.unit(Cell::consumer).budget = milliseconds{20};
  cell.rests_until = Time::max();
  cell.run(milliseconds{400});
  CHECK_EQUAL(cell.taken(), 0U);
  for (std::size_t i = 6; i < cell.seen.size(); ++i)
    CHECK_EQUAL(cell.seen[i].at - cell.seen[i - 1].at, 36'000);
  CHECK(cell.seen.size() > 8);
}

// [exec-10] [exec-86]
void what_waits_is_no_timeout() {
  BurstCell cell(on_jobs({}, milliseconds{10}));
  cell.rests_until = beginning + milliseconds{100};
  cell.run(milliseconds{200});
  CHECK_EQUAL(cell.taken(), 5U);
  bool has_taken_all = false;
  for (std::size_t i = 0, taken = 0; i < cell.seen.size(); ++i) {
    const bool waits = cell.seen[i].at > 3000 && !has_taken_all;
    CHECK_EQUAL(cell.seen[i].fired, waits ? 1U : 0U);
    CHECK_EQUAL(cell.seen[i].timed_out, !waits);
    // A timeout bounds the pauses, too.
    if (i > 0) CHECK(cell.seen[i].at - cell.seen[i - 1].at <= 10'000);
    taken += cell.seen[i].took ? 1 : 0;
    has_taken_all = taken == 5;
  }
  CHECK(has_taken_all);
}

// [exec-12] [exec-86]
void back_off_works_a_burst_off_and_learns_only_arrivals() {
  std::array<Duration, 2> means{};
  for (const bool one_by_one : {true, false}) {
    BurstCell cell(backing_off_on_jobs(microseconds{200}, milliseconds{50}));
    cell.every = 40;
    if (!one_by_one) {
      cell.unit(Cell::consumer).script.step = [&](TestUnit& unit, const Tick& tick) {
        if (tick.stop_requested) return;
        while (unit.jobs.pop()) cell.seen.push_back({0, 1, false, true});
        cell.mean = Duration{cell.thread_state(Cell::consuming).backoff_mean.load()};
      };
    }
    cell.run(std::chrono::seconds{4});
    CHECK(cell.taken() >= 490 && cell.taken() <= 500);
    if (one_by_one) {
      // Not before the shortest sleep, and four of five by what waits alone.
      std::size_t shortest = 0;
      for (std::size_t i = 1; i < cell.seen.size(); ++i) {
        const std::int64_t gap = cell.seen[i].at - cell.seen[i - 1].at;
        CHECK(gap >= 200);
        shortest += gap == 200 ? 1 : 0;
      }
      CHECK(shortest >= cell.taken() / 5 * 4 - 5);
      CHECK(std::ranges::all_of(cell.seen, [](const Seen& one) { return one.took && one.fired == 1; }));
    }
    means[one_by_one ? 0 : 1] = cell.mean;
  }
  CHECK(means[1] > milliseconds{38} && means[1] < milliseconds{42});
  CHECK_EQUAL(means[0].count(), means[1].count());
}

// [exec-87]
void back_off_offers_a_full_queue_until_its_reader_takes() {
  BurstCell cell(backing_off_on_jobs(microseconds{500}, milliseconds{20}));
  cell.every = 1;
  cell.burst = 16;
  cell.rests_until = beginning + milliseconds{200};
  cell.run(milliseconds{300});
  std::vector<std::int64_t> pauses;
  std::int64_t longest = 0;
  for (std::size_t i = 1; i < cell.seen.size() && !cell.seen[i].took; ++i) {
    const std::int64_t pause = cell.seen[i].at - cell.seen[i - 1].at - budget.count() / 1000;
    if (i <= 5) pauses.push_back(pause);
    longest = std::max(longest, pause);
  }
  CHECK((pauses == std::vector<std::int64_t>{500, 1000, 2000, 4000, 8000}));
  CHECK_EQUAL(longest, 20'000);
  const auto first = std::ranges::find_if(cell.seen, [](const Seen& one) { return one.took; });
  CHECK(first != cell.seen.end());
  CHECK(first->at >= 200'000 && first->at < 221'000);
  CHECK(cell.taken() > 90);
}

/// A unit takes what it cannot complete in this step, as a job whose picture is not there yet. The queue is
/// empty then, and nothing comes any more.
// [exec-88]
void what_a_unit_took_and_holds_releases_it_again() {
  for (const TriggerPlan& trigger : {on_jobs(), backing_off_on_jobs(microseconds{200}, milliseconds{50})}) {
    BurstCell cell(trigger);
    cell.burst = 1;
    std::vector<Time> steps;
    std::optional<Item> held;
    constexpr std::size_t enough = 4;  // steps that it takes
    cell.unit(Cell::consumer).script.step = [&](TestUnit& unit, const Tick& tick) {
      if (tick.stop_requested) return;
      if (const auto job = unit.jobs.pop()) held = *job;
      if (!held) return;
      CHECK_EQUAL(tick.fired, 1U);
      CHECK(!tick.timed_out);
      steps.push_back(tick.now);
      if (steps.size() == enough) held.reset();
    };
    cell.unit(Cell::consumer).script.is_idle = [&](const TestUnit&) { return !held; };
    cell.run(milliseconds{300});
    CHECK_EQUAL(steps.size(), enough);
    // The first after the step that took it, the others in growing pauses.
    CHECK(steps[1] - steps[0] <= microseconds{300});
    CHECK(steps[3] - steps[2] > steps[2] - steps[1]);
    CHECK(steps.back() - steps.front() < milliseconds{10});
  }
}

/// Of a queue that others read a thread is told of arrivals alone.
// [exec-8]
void what_waits_for_others_releases_nobody_else() {
  BurstCell cell(on_jobs());
  cell.rests_until = Time::max();
  int looks = 0;
  UnitPlan onlooker;
  onlooker.name = "onlooker";
  onlooker.script.step = [&looks](TestUnit&, const Tick& tick) { looks += tick.stop_requested ? 0 : 1; };
  const std::uint16_t index = cell.add(std::move(onlooker));
  cell.add(ThreadPlan{.name = "onlooking", .trigger = on_jobs(), .units = {index}, .devices = {}});
  cell.run(milliseconds{100});
  CHECK_EQUAL(looks, 1);
  CHECK(cell.seen.size() > 5);
}

// [exec-86]
void a_device_works_off_what_waits_too() {
  BurstCell cell(on_jobs());
  cell.unit(Cell::consumer).pops = no_index;
  cell.device(Cell::actuator).pops = Cell::jobs;
  int taken = 0;
  cell.device(Cell::actuator).script.receive = [&taken](TestDevice& device, const Tick&) {
    taken += device.jobs.pop() ? 1 : 0;
  };
  cell.run(milliseconds{50});
  CHECK_EQUAL(taken, 5);
  CHECK((cell.times() == std::vector<std::int64_t>{3050, 3100, 3150, 3200, 3250}));
}

/// On the wall clock: nobody rings, and the thread sleeps.
// [exec-86] [exec-87]
void what_waits_wakes_a_sleeping_thread() {
  for (const TriggerPlan& trigger :
       {on_jobs(), on_jobs(milliseconds{1}), backing_off_on_jobs(microseconds{200}, milliseconds{10})}) {
    Cell cell;
    cell.thread(Cell::consuming).trigger = trigger;
    cell.unit(Cell::producer).script.step = [](TestUnit& unit, const Tick& tick) {
      for (int i = 0; i < 16 && tick.number == burst_at; ++i) unit.orders.push(Item{});
    };
    std::atomic<bool> rests{true};
    std::atomic<int> offered{0};
    std::atomic<int> taken{0};
    cell.unit(Cell::consumer).script.step = [&](TestUnit& unit, const Tick& tick) {
      if (tick.stop_requested) return;
      if (rests)
        ++offered;
      else if (unit.jobs.pop())
        ++taken;
    };
    RunningCell running(cell);
    running.start();
    CHECK(wait_until([&] { return offered >= 5; }));
    rests = false;
    CHECK(wait_until([&] { return taken == 16; }));
    CHECK_EQUAL(running.finish().exit_code, 0);
  }
}

}  // namespace
}  // namespace flexrf::fixture::waiting_test

int main() {
  using namespace flexrf::fixture::waiting_test;
  const CMUnitTest tests[] = {
      CONTAINED_TEST(a_burst_is_worked_off_one_by_one),
      CONTAINED_TEST(a_burst_keeps_the_least_interval),
      CONTAINED_TEST(a_full_queue_is_offered_until_its_reader_takes),
      CONTAINED_TEST(a_long_step_that_takes_nothing_rests_too),
      CONTAINED_TEST(what_waits_is_no_timeout),
      CONTAINED_TEST(back_off_works_a_burst_off_and_learns_only_arrivals),
      CONTAINED_TEST(back_off_offers_a_full_queue_until_its_reader_takes),
      CONTAINED_TEST(what_a_unit_took_and_holds_releases_it_again),
      CONTAINED_TEST(what_waits_for_others_releases_nobody_else),
      CONTAINED_TEST(a_device_works_off_what_waits_too),
      CONTAINED_TEST(what_waits_wakes_a_sleeping_thread),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
