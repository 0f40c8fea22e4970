// What waits in a queue, and the trigger of a reader: the test is the clock, and the step.
#include <array>

#include "runtime/blackboard/job_queue.hpp"
#include "runtime/executive/tests/checks.hpp"
#include "runtime/executive/tests/fixture_components.hpp"
#include "runtime/executive/trigger.hpp"

namespace flexrf::fixture::waiting_trigger_test {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;

constexpr Time beginning{std::chrono::seconds{1}};

/// Jobs for several readers, and a trigger of one of them.
struct Pool {
  bool push() {
    const Item item{};
    return sink.push(&item, beginning);
  }
  bool pop() {
    Item item{};
    ItemHeader header{};
    return queue.pop(&item, header);
  }

  JobQueueMemory<Item, 8> memory{};
  JobQueue queue{descriptor_of<Item>, memory.view(), DropPolicy::drop_newest};
  JobSink sink{&queue};
  const std::array<TriggerSource, 1> sources{TriggerSource{nullptr, &queue}};
  const Application application{};
};

TriggerRecord waiting_for(const Pool& pool) {
  TriggerRecord record{};
  record.kind = TriggerKind::slots;
  record.sources = pool.sources;
  return record;
}

TriggerRecord polling(const Pool& pool) {
  TriggerRecord record{};
  record.kind = TriggerKind::backoff;
  record.sources = pool.sources;
  record.shortest = milliseconds{1};
  record.longest = milliseconds{20};
  record.tries = 4;
  return record;
}

/// One reader rests, the other takes a job each millisecond. The first is offered what waits, but not more
/// often for all that the other takes, and both sleep when nothing waits.
// [exec-87]
void readers_of_one_queue_do_not_keep_each_other_awake() {
  Pool pool;
  const TriggerRecord record = waiting_for(pool);
  Trigger resting(record, pool.application, 1);
  Trigger taking(record, pool.application, 1);
  resting.begin(beginning);
  taking.begin(beginning);
  // Nothing waits when they begin.
  CHECK(resting.due(beginning, false).at == Time::max());
  CHECK(taking.due(beginning, false).at == Time::max());
  while (pool.push()) continue;
  int offers = 0;
  int takes = 0;
  Time at = beginning;
  const auto release = [&at](Trigger& trigger) {
    if (trigger.due(at, false).at > at) return false;
    trigger.released(at, at);
    return true;
  };
  for (; pool.queue.fill() > 0; at += milliseconds{1}) {
    if (release(resting)) {
      ++offers;
      resting.due(at, false);  // the look after a step that took nothing
    }
    if (release(taking)) takes += pool.pop() ? 1 : 0;
    taking.due(at, false);
    CHECK(at < beginning + milliseconds{100});
  }
  CHECK_EQUAL(takes, 8);
  // The arrival, and after 1, 2 and 4 ms.
  CHECK_EQUAL(offers, 4);
  CHECK(resting.due(at, false).at == Time::max());
  CHECK(taking.due(at, false).at == Time::max());
}

// [exec-87]
void what_waited_before_the_start_is_offered() {
  Pool pool;
  pool.push();
  const TriggerRecord slots = waiting_for(pool);
  const TriggerRecord backoff = polling(pool);
  for (const TriggerRecord* record : {&slots, &backoff}) {
    Trigger trigger(*record, pool.application, 1);
    trigger.begin(beginning);
    const Time offered = beginning + milliseconds{1};
    CHECK(trigger.due(beginning, false).at > beginning);
    const Due due = trigger.due(offered, false);
    CHECK_EQUAL(nanoseconds(due.at), nanoseconds(offered));
    CHECK_EQUAL(due.fired, 1U);
  }
}

/// The response times are computed from it.
// [exec-86]
void two_releases_by_back_off_are_never_closer_than_the_shortest_sleep() {
  Pool pool;
  const TriggerRecord record = polling(pool);
  Trigger trigger(record, pool.application, 1);
  trigger.begin(beginning);
  Time last{};
  // Jobs come each 3.7 ms, three at once, while the reader takes one in a step.
  for (int step = 0; step < 40'000; ++step) {
    const Time now = beginning + step * microseconds{10};
    if (step % 370 == 0)
      for (int i = 0; i < 3; ++i) pool.push();
    if (trigger.due(now, false).at > now) continue;
    CHECK(now - last >= milliseconds{1});
    trigger.released(now, now);
    last = now;
    pool.pop();
  }
  CHECK(pool.queue.departures() >= 300);
}

}  // namespace
}  // namespace flexrf::fixture::waiting_trigger_test

int main() {
  using namespace flexrf::fixture::waiting_trigger_test;
  const CMUnitTest tests[] = {
      CONTAINED_TEST(readers_of_one_queue_do_not_keep_each_other_awake),
      CONTAINED_TEST(what_waited_before_the_start_is_offered),
      CONTAINED_TEST(two_releases_by_back_off_are_never_closer_than_the_shortest_sleep),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
