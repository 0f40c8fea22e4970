// The five triggers, and what a step is told of its release.
#include "runtime/executive/trigger.hpp"

#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

#include "runtime/executive/tests/running_cell.hpp"

namespace flexrf::fixture::trigger_test {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;
using Cell = ProducerAndConsumer;

constexpr Time beginning{std::chrono::seconds{1}};  // of virtual time

/// A script that keeps the ticks of ordinary steps, and leaves nothing in its queue.
std::function<void(TestUnit&, const Tick&)> recording(std::vector<Tick>& ticks) {
  return [&ticks](TestUnit& unit, const Tick& tick) {
    while (unit.jobs.pop()) continue;
    if (!tick.stop_requested) ticks.push_back(tick);
  };
}

std::vector<Tick> ticks_of_consumer(Cell& cell, Duration duration) {
  std::vector<Tick> ticks;
  cell.unit(Cell::consumer).script.step = recording(ticks);
  Executive executive(cell.application(), in_virtual_time(duration));
  CHECK_EQUAL(run_to_the_end(executive).exit_code, 0);
  return ticks;
}

// [exec-7] [exec-16]
void a_period_has_its_phase_and_no_drift() {
  Cell cell;
  cell.thread(Cell::consuming).trigger = TriggerPlan::periodic(milliseconds{7}, milliseconds{2});
  const std::vector<Tick> ticks = ticks_of_consumer(cell, milliseconds{50});
  CHECK_EQUAL(ticks.size(), 7U);
  for (std::size_t i = 0; i < ticks.size(); ++i) {
    CHECK_EQUAL(nanoseconds(ticks[i].nominal),
                nanoseconds(beginning + milliseconds{2 + 7 * static_cast<int>(i)}));
    CHECK_EQUAL(ticks[i].lateness.count(), 0);
    CHECK_EQUAL(nanoseconds(ticks[i].now), nanoseconds(ticks[i].nominal));
    CHECK_EQUAL(ticks[i].elapsed.count(), i == 0 ? 0 : 7'000'000);
    CHECK_EQUAL(ticks[i].number, i);
    CHECK_EQUAL(ticks[i].fired, 0U);
    CHECK(!ticks[i].timed_out && !ticks[i].finishing && !ticks[i].motion_inhibited);
  }
}

// [exec-8] [exec-53]
void a_publication_releases_when_it_becomes_visible() {
  Cell cell;
  const std::vector<Tick> ticks = ticks_of_consumer(cell, milliseconds{10});
  CHECK_EQUAL(ticks.size(), 10U);
  for (std::size_t i = 0; i < ticks.size(); ++i) {
    // The producer's budget later than its release.
    CHECK_EQUAL(nanoseconds(ticks[i].now), nanoseconds(beginning + milliseconds{i} + microseconds{50}));
    CHECK_EQUAL(ticks[i].fired, 3U);
  }
}

// [exec-8] [exec-16]
void the_tick_says_which_source_fired() {
  Cell cell;
  cell.unit(Cell::producer).script.step = [](TestUnit& unit, const Tick& tick) {
    if (tick.number == 3) unit.outputs[0].publish(Item{});
    if (tick.number == 5) unit.orders.push(Item{});
  };
  const std::vector<Tick> ticks = ticks_of_consumer(cell, milliseconds{10});
  CHECK_EQUAL(ticks.size(), 2U);
  CHECK_EQUAL(ticks[0].fired, 1U);
  CHECK_EQUAL(ticks[1].fired, 2U);
  CHECK_EQUAL(ticks[1].elapsed.count(), 2'000'000);
}

// [exec-8] [exec-16]
void as_many_sources_as_there_may_be_have_a_bit_each() {
  Cell cell;
  cell.thread(Cell::consuming).trigger =
      TriggerPlan::on_slots(std::vector<std::uint16_t>(Trigger::max_sources, Cell::values));
  const std::vector<Tick> ticks = ticks_of_consumer(cell, milliseconds{3});
  CHECK_EQUAL(ticks.size(), 3U);
  for (const Tick& tick : ticks) CHECK_EQUAL(tick.fired, 0xFFFF'FFFFU);
}

void a_publication_between_the_look_and_the_release_fires_the_next() {
  Cell cell;
  const std::uint16_t late = cell.add(SlotPlan{.name = "late"});
  cell.thread(Cell::consuming).trigger = TriggerPlan::on_slots({Cell::values, late});
  const Application& application = cell.application();
  const auto publish = [&cell](std::uint16_t slot) {
    const std::uint8_t buffer = cell.slot_control(slot).loan();
    CHECK(buffer != SlotControl::none);
    cell.slot_control(slot).publish(buffer, beginning);
  };
  Trigger trigger(application.threads[Cell::consuming].trigger, application, 0);
  trigger.begin(beginning);
  publish(Cell::values);
  CHECK_EQUAL(trigger.due(beginning, false).fired, 1U);
  publish(late);
  trigger.released(beginning, beginning);
  const Time now = beginning + milliseconds{1};
  const Due next = trigger.due(now, false);
  CHECK_EQUAL(next.fired, 2U);
  CHECK_EQUAL(nanoseconds(next.at), nanoseconds(now));
  trigger.released(now, now);
  CHECK_EQUAL(trigger.due(now, false).fired, 0U);
}

/// On the wall clock: in virtual time nothing is late.
// [exec-75]
void a_period_is_late_against_its_instant() {
  Cell cell;
  cell.thread(Cell::consuming).trigger = TriggerPlan::periodic(milliseconds{1});
  std::vector<Tick> ticks;
  cell.unit(Cell::consumer).script.step = [&](TestUnit&, const Tick& tick) {
    if (tick.number % 4 == 0) usleep(1500);  // the next begins when this ends
    if (ticks.size() < 40) ticks.push_back(tick);
  };
  RunningCell running(cell);
  running.start();
  CHECK(wait_until([&] { return cell.unit_state(Cell::consumer).steps > 40; }));
  CHECK_EQUAL(running.finish().exit_code, 0);
  Duration latest{};
  for (const Tick& tick : ticks) {
    CHECK_EQUAL((tick.nominal - ticks[0].nominal).count() % 1'000'000, 0);
    CHECK_EQUAL(tick.lateness.count(), (tick.now - tick.nominal).count());
    latest = std::max(latest, tick.lateness);
  }
  CHECK(latest.count() > 0);
}

// [exec-75]
void what_has_no_period_is_late_against_when_it_was_noticed() {
  TriggerPlan with_timeout = TriggerPlan::on_slots({});
  with_timeout.timeout = milliseconds{1};
  for (const TriggerPlan& trigger :
       {TriggerPlan::on_slots({Cell::values}), with_timeout, TriggerPlan::free_running(),
        TriggerPlan::backing_off(Cell::values, microseconds{100}, milliseconds{5})}) {
    Cell cell;
    cell.thread(Cell::consuming).trigger = trigger;
    std::atomic<bool> is_late{false};
    cell.unit(Cell::consumer).script.step = [&](TestUnit&, const Tick& tick) {
      if (tick.lateness.count() != 0 || tick.nominal != tick.now) is_late = true;
    };
    RunningCell running(cell);
    running.start();
    CHECK(wait_until([&] { return cell.unit_state(Cell::consumer).steps > 20; }));
    CHECK_EQUAL(running.finish().exit_code, 0);
    CHECK(!is_late);
  }
}

// [exec-9] [exec-15]
void publications_in_between_make_one_release() {
  Cell cell;
  cell.thread(Cell::consuming).trigger.min_interval = milliseconds{5};
  std::vector<std::uint64_t> missed;
  std::vector<Tick> ticks;
  cell.unit(Cell::consumer).script.step = [&](TestUnit& unit, const Tick& tick) {
    if (tick.stop_requested) return;
    missed.push_back(unit.inputs[0].latest().missed());
    ticks.push_back(tick);
  };
  Executive executive(cell.application(), in_virtual_time(milliseconds{51}));
  CHECK_EQUAL(run_to_the_end(executive).exit_code, 0);
  CHECK(ticks.size() >= 10);
  for (std::size_t i = 2; i < ticks.size(); ++i) {
    CHECK_EQUAL((ticks[i].now - ticks[i - 1].now).count(), 5'000'000);
    CHECK_EQUAL(missed[i], 4U);
  }
}

// [exec-10] [exec-16]
void a_timeout_is_a_release_of_its_own() {
  Cell cell;
  cell.thread(Cell::consuming).trigger.timeout = milliseconds{10};
  cell.unit(Cell::producer).script.step = [](TestUnit& unit, const Tick& tick) {
    if (tick.number < 3 || tick.number == 40) unit.outputs[0].publish(Item{});
  };
  const std::vector<Tick> ticks = ticks_of_consumer(cell, milliseconds{60});
  std::vector<std::int64_t> timeouts;
  for (const Tick& tick : ticks) {
    CHECK_EQUAL(tick.timed_out, tick.fired == 0);
    if (tick.timed_out) timeouts.push_back((tick.now - beginning).count() / 1000);
  }
  CHECK_EQUAL(ticks.size(), 8U);
  CHECK((timeouts == std::vector<std::int64_t>{12'050, 22'050, 32'050, 50'050}));
}

// [exec-11]
void a_device_releases_its_thread_in_virtual_time() {
  Cell cell;
  cell.thread(Cell::consuming).trigger = TriggerPlan::on_device(Cell::actuator);
  Time next = beginning + milliseconds{3};
  cell.device(Cell::actuator).script.next_event = [&] { return next; };
  cell.device(Cell::actuator).script.receive = [&](TestDevice&, const Tick& tick) {
    if (tick.now >= next) next += milliseconds{4};
  };
  const std::vector<Tick> ticks = ticks_of_consumer(cell, milliseconds{20});
  CHECK_EQUAL(ticks.size(), 5U);
  for (std::size_t i = 0; i < ticks.size(); ++i) {
    CHECK_EQUAL((ticks[i].now - beginning).count(), 3'000'000 + 4'000'000 * static_cast<std::int64_t>(i));
    CHECK_EQUAL(ticks[i].fired, 1U);
  }
}

// [exec-11]
void before_a_device_has_something_it_is_the_timeout() {
  Cell cell;
  cell.thread(Cell::consuming).trigger = TriggerPlan::on_device(Cell::actuator);
  cell.thread(Cell::consuming).trigger.timeout = milliseconds{1};
  Time next = beginning + microseconds{3500};
  cell.device(Cell::actuator).script.next_event = [&] { return next; };
  cell.device(Cell::actuator).script.receive = [&](TestDevice&, const Tick& tick) {
    if (tick.now >= next) next += milliseconds{4};
  };
  const std::vector<Tick> ticks = ticks_of_consumer(cell, milliseconds{9});
  std::vector<std::int64_t> events;
  for (const Tick& tick : ticks) {
    CHECK_EQUAL(tick.timed_out, tick.fired == 0);
    if (tick.fired == 1) events.push_back((tick.now - beginning).count() / 1000);
  }
  CHECK_EQUAL(ticks.size(), 9U);
  CHECK((events == std::vector<std::int64_t>{3500, 7500}));
}

// [exec-11] [exec-75]
void a_device_releases_its_thread_on_the_wall_clock() {
  Cell cell;
  cell.thread(Cell::consuming).trigger = TriggerPlan::on_device(Cell::actuator);
  const int descriptor = eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC);
  std::atomic<Time> written{Time{}};
  std::atomic<bool> is_due_before_it_came{false};
  std::atomic<std::uint64_t> received{0};
  std::atomic<int> released{0};
  cell.device(Cell::actuator).script.descriptor = [descriptor] { return descriptor; };
  cell.device(Cell::actuator).script.receive = [&](TestDevice&, const Tick& tick) {
    std::uint64_t value = 0;
    if (read(descriptor, &value, sizeof(value)) != sizeof(value)) return;
    if (tick.nominal < written.load()) is_due_before_it_came = true;
    received += value;
  };
  cell.unit(Cell::consumer).script.step = [&](TestUnit&, const Tick& tick) {
    released += tick.fired == 1 ? 1 : 0;
  };
  RunningCell running(cell);
  running.start();
  CHECK(wait_until([&] { return running.control().mode() == Mode::running; }));
  for (std::uint64_t i = 1; i <= 5; ++i) {
    const std::uint64_t one = 1;
    written = MonotonicClock::now();
    CHECK_EQUAL(write(descriptor, &one, sizeof(one)), 8);
    CHECK(wait_until([&] { return received == i; }));
  }
  CHECK(wait_until([&] { return released >= 5; }));
  CHECK(!is_due_before_it_came);
  CHECK_EQUAL(running.finish().exit_code, 0);
  close(descriptor);
}

/// By a unit or a library, say. The driver learns of it, and no thread turns in circles.
// [stop-107]
void a_device_whose_descriptor_was_closed_by_others_learns_of_it() {
  Cell cell;
  cell.thread(Cell::consuming).trigger = TriggerPlan::on_device(Cell::actuator);
  const int descriptor = eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC);
  std::atomic<bool> is_closed{false};
  cell.device(Cell::actuator).script.descriptor = [&, descriptor] { return is_closed ? -1 : descriptor; };
  cell.device(Cell::actuator).script.receive = [&, descriptor](TestDevice&, const Tick&) {
    std::uint64_t value = 0;
    is_closed = read(descriptor, &value, sizeof(value)) < 0 && errno == EBADF;
  };
  RunningCell running(cell);
  running.start();
  CHECK(wait_until([&] { return running.control().mode() == Mode::running; }));
  close(descriptor);
  // It sleeps on what was closed until somebody rings.
  running.control().wake_all();
  CHECK(wait_until([&] { return is_closed.load(); }));
  CHECK_EQUAL(running.finish().exit_code, 0);
}

void a_flood_does_not_turn_a_thread_in_circles() {
  Cell cell;
  TriggerPlan& trigger = cell.thread(Cell::consuming).trigger;
  trigger = TriggerPlan::on_device(Cell::actuator);
  trigger.min_interval = milliseconds{20};
  const int descriptor = eventfd(1, EFD_NONBLOCK | EFD_CLOEXEC);
  std::atomic<int> looks{0};
  cell.device(Cell::actuator).script.descriptor = [&, descriptor] {
    ++looks;
    return descriptor;  // always readable
  };
  RunningCell running(cell);
  running.start();
  const std::atomic<std::uint64_t>& releases = cell.thread_state(Cell::consuming).cycles;
  CHECK(wait_until([&] { return cell.unit_state(Cell::consumer).steps > 10; }));
  // The looks first: whatever comes about in between is releases with their few looks.
  const auto looks_before = static_cast<std::uint64_t>(looks);
  CHECK(looks_before < 20 * releases);
  CHECK_EQUAL(running.finish().exit_code, 0);
  close(descriptor);
}

// [exec-12]
void back_off_finds_every_item_of_a_steady_source_soon() {
  Cell cell;
  cell.thread(Cell::producing).trigger = TriggerPlan::periodic(milliseconds{10});
  cell.thread(Cell::consuming).trigger =
      TriggerPlan::backing_off(Cell::values, microseconds{100}, milliseconds{50});
  std::vector<Duration> ages;
  std::uint64_t missed = 0;
  Duration mean{};
  Duration spread{};
  cell.unit(Cell::consumer).script.step = [&](TestUnit& unit, const Tick& tick) {
    if (tick.stop_requested) return;
    // While it stops it is released at other times, too.
    mean = Duration{cell.thread_state(Cell::consuming).backoff_mean.load()};
    spread = Duration{cell.thread_state(Cell::consuming).backoff_spread.load()};
    const View<Item> view = unit.inputs[0].latest();
    CHECK(view.is_new());
    ages.push_back(view.age());
    missed += view.missed();
  };
  Executive executive(cell.application(), in_virtual_time(std::chrono::seconds{2}));
  CHECK_EQUAL(run_to_the_end(executive).exit_code, 0);
  CHECK(ages.size() + missed + 2 >= 200);
  CHECK(missed <= 10);
  std::sort(ages.begin(), ages.end());
  CHECK(ages[ages.size() / 2] < milliseconds{1});
  CHECK(mean > milliseconds{9} && mean < milliseconds{11});
  CHECK(spread < milliseconds{1});
  CHECK_EQUAL(cell.thread_state(Cell::producing).backoff_mean.load(), 0);
}

// [exec-13]
void a_free_thread_steps_without_a_reason() {
  Cell cell;
  cell.thread(Cell::consuming).trigger = TriggerPlan::free_running();
  cell.unit(Cell::consumer).budget = microseconds{20};
  const std::vector<Tick> ticks = ticks_of_consumer(cell, milliseconds{10});
  CHECK(ticks.size() >= 490);
  Cell other;
  other.thread(Cell::consuming).trigger = TriggerPlan::free_running();
  other.unit(Cell::producer).script.step = {};  // there is no other reason
  RunningCell running(other);
  running.start();
  // Where others want its CPU it goes to the end of their queue after each step.
  CHECK(wait_until([&] { return other.unit_state(Cell::consumer).steps > 100; }));
  CHECK_EQUAL(running.finish().exit_code, 0);
}

}  // namespace
}  // namespace flexrf::fixture::trigger_test

int main() {
  using namespace flexrf::fixture::trigger_test;
  const CMUnitTest tests[] = {
      CONTAINED_TEST(a_period_has_its_phase_and_no_drift),
      CONTAINED_TEST(a_publication_releases_when_it_becomes_visible),
      CONTAINED_TEST(the_tick_says_which_source_fired),
      CONTAINED_TEST(as_many_sources_as_there_may_be_have_a_bit_each),
      CONTAINED_TEST(a_publication_between_the_look_and_the_release_fires_the_next),
      CONTAINED_TEST(a_period_is_late_against_its_instant),
      CONTAINED_TEST(what_has_no_period_is_late_against_when_it_was_noticed),
      CONTAINED_TEST(publications_in_between_make_one_release),
      CONTAINED_TEST(a_timeout_is_a_release_of_its_own),
      CONTAINED_TEST(a_device_releases_its_thread_in_virtual_time),
      CONTAINED_TEST(before_a_device_has_something_it_is_the_timeout),
      CONTAINED_TEST(a_device_releases_its_thread_on_the_wall_clock),
      CONTAINED_TEST(a_device_whose_descriptor_was_closed_by_others_learns_of_it),
      CONTAINED_TEST(a_flood_does_not_turn_a_thread_in_circles),
      CONTAINED_TEST(back_off_finds_every_item_of_a_steady_source_soon),
      CONTAINED_TEST(a_free_thread_steps_without_a_reason),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
