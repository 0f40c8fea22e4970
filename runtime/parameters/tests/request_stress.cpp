// Requests from several threads to one owner, and its answers back, all at full rate: for the thread
// sanitizer.
#include <array>
#include <atomic>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <thread>
#include <vector>

#include "runtime/blackboard/stress.hpp"
#include "runtime/parameters/parameter_store.hpp"
#include "runtime/parameters/tests/sample_component.hpp"
#include "tests/cmocka.hpp"

namespace flexrf {
namespace {

constexpr std::uint32_t producers = 4;

struct Marked {
  std::uint32_t producer;
  std::uint32_t number;
  std::uint64_t copies[14];  // torn values show
};

// A small capacity, so that cells are reused all the time and producers meet at both ends.
struct IntakeRun {
  Intake<Marked, 6> intake;
  std::atomic<std::uint64_t> refused{0};
  std::atomic<std::uint32_t> finished{0};
};

bool run_intake(std::uint32_t items) {
  auto run = std::make_unique<IntakeRun>();
  std::vector<std::thread> threads;
  for (std::uint32_t producer = 0; producer < producers; ++producer) {
    threads.emplace_back([&run = *run, producer, items] {
      Marked item{};
      item.producer = producer;
      std::uint64_t refused = 0;
      for (std::uint32_t number = 1; number <= items; ++number) {
        item.number = number;
        for (std::uint64_t& copy : item.copies) copy = number;
        for (; !run.intake.put(item); ++refused) test::pass_time();
      }
      run.refused.fetch_add(refused);
      run.finished.fetch_add(1, std::memory_order_release);
    });
  }
  bool is_right = true;
  std::array<std::uint32_t, producers> last{};
  Marked item{};
  while (true) {
    const bool is_last = run->finished.load(std::memory_order_acquire) == producers;
    while (run->intake.take(item)) {
      is_right = is_right && item.producer < producers && item.number == last[item.producer] + 1;
      for (const std::uint64_t copy : item.copies) is_right = is_right && copy == item.number;
      last[item.producer] = item.number;
    }
    if (is_last) break;
    test::pass_time();
  }
  for (std::thread& thread : threads) thread.join();
  for (const std::uint32_t number : last) is_right = is_right && number == items;
  return is_right && run->intake.accepted() == std::uint64_t{producers} * items &&
         run->intake.refused() == run->refused.load();
}

void an_intake_loses_and_tears_nothing(void**) {
  assert_true(run_intake(std::getenv("FLEXRF_LONG") != nullptr ? 1'000'000 : 30'000));
}

// Two requesters change two fields that must agree (the component's accept), a third one reads the values in
// force.
struct CellRun {
  sample::SampleComponent component;
  Slot<sample::Runtime, 1> slot;
  ParameterScratch scratch{};
  RuntimeParameters parameters;
  RequestQueue requests;
  AnswerQueue answers[2];
  Doorbell owner;
  Doorbell requesters[2];
  std::atomic<std::uint32_t> finished{0};
  std::atomic<bool> done{false};
};

// Returns how many answers of the right kind came, each exactly once and in order; 0 when something was
// wrong.
std::uint32_t request_changes(CellRun& run, std::uint16_t requester, std::uint32_t count) {
  ParameterRequest request;
  ParameterAnswer answer;
  std::uint32_t answered = 0;
  bool is_right = true;
  const auto fetch = [&] {
    while (run.answers[requester].pop(answer)) {
      // Every fourth request is out of range.
      const AnswerKind expected = answer.correlation % 4 == 3 ? AnswerKind::refused : AnswerKind::accepted;
      is_right = is_right && answer.kind == expected && answer.correlation == answered;
      ++answered;
    }
  };
  // Sleeps until another answer has come.
  const auto fetch_next = [&] {
    const std::uint32_t before = answered;
    while (true) {
      const std::uint32_t heard = run.requesters[requester].listen();
      fetch();
      if (answered > before) return;
      run.requesters[requester].wait(heard, Time::max());
    }
  };
  for (std::uint32_t i = 0; i < count; ++i) {
    request = ParameterRequest{};
    request.requester = requester;
    request.correlation = i;
    const double low = i % 4 == 3 ? std::numeric_limits<double>::infinity() : -1.0 - i;
    const float high = static_cast<float>(i) + 1;
    const sample::Limits limits{low, high};
    request.add(sample::limits, 0, &limits, sizeof(limits));
    while (!run.requests.push(request)) {
      fetch();
      test::pass_time();
    }
    while (i + 1 - answered > AnswerQueue::capacity / 2) fetch_next();
  }
  while (answered < count) fetch_next();
  run.finished.fetch_add(1);
  run.owner.ring();
  return is_right ? answered : 0;
}

void own(CellRun& run) {
  ParameterRequest request;
  std::int64_t now = 1;
  while (run.finished.load() < 2) {
    const std::uint32_t heard = run.owner.listen();
    bool any = false;
    while (run.requests.pop(request)) {
      any = true;
      run.answers[request.requester].push(run.parameters.apply(request, Time{Duration{++now}}));
    }
    if (!any && run.finished.load() < 2) run.owner.wait(heard, Time::max());
  }
  run.done = true;
}

// Returns the last sequence it saw, also where it gets no CPU before all is done; 0 when something was wrong.
std::uint64_t watch(CellRun& run) {
  std::uint8_t held = SlotControl::none;
  std::uint64_t last = 0;
  bool is_right = true;
  for (;;) {
    const bool was_done = run.done;
    if (!run.slot.control().take(held)) {
      if (was_done) break;
      test::pass_time();
      continue;
    }
    const auto& values = *reinterpret_cast<const sample::Runtime*>(run.slot.control().payload(held));
    const std::uint64_t sequence = run.slot.control().header(held).sequence;
    // Both members are from the same request.
    is_right = is_right && sequence > last && values.limits.low == -static_cast<double>(values.limits.high);
    last = sequence;
  }
  return is_right ? last : 0;
}

bool run_cell(std::uint32_t count) {
  auto run = std::make_unique<CellRun>();
  run->requests.set_bell(&run->owner);
  for (std::size_t i = 0; i < 2; ++i) run->answers[i].set_bell(&run->requesters[i]);
  if (!run->parameters.connect(run->component, &run->slot.control(), &sample::default_runtime, run->scratch))
    return false;
  if (!run->parameters.adopt(&sample::default_runtime, Time{Duration{1}})) return false;
  std::uint32_t answered[2] = {};
  std::uint64_t seen = 0;
  std::thread owner([&run] { own(*run); });
  std::thread observer([&run, &seen] { seen = watch(*run); });
  std::thread other([&run, &answered, count] { answered[1] = request_changes(*run, 1, count); });
  answered[0] = request_changes(*run, 0, count);
  other.join();
  owner.join();
  observer.join();
  return seen == run->parameters.sequence() && answered[0] == count && answered[1] == count &&
         run->answers[0].dropped() == 0 && run->parameters.sequence() == 1 + 2 * (count - count / 4);
}

void requests_are_answered_once_and_in_order(void**) {
  assert_true(run_cell(std::getenv("FLEXRF_LONG") != nullptr ? 150'000 : 8'000));
}

}  // namespace
}  // namespace flexrf

int main() {
  using namespace flexrf;
  const CMUnitTest tests[] = {
      cmocka_unit_test(an_intake_loses_and_tears_nothing),
      cmocka_unit_test(requests_are_answered_once_and_in_order),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
