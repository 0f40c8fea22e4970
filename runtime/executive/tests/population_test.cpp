// Populations: members that are activated, cloned and retired while the application runs.
#include "runtime/executive/tests/running_cell.hpp"

namespace flexrf::fixture::population_test {
namespace {

using std::chrono::milliseconds;

constexpr std::uint16_t capacity = 4;

/// Members 0 to 3 publish their gain in slots 0 to 3, a reader (unit 4) reads them all in another thread.
class Population : public TestApplication {
 public:
  Population() {
    UnitPlan reading;
    for (std::uint16_t i = 0; i < capacity; ++i) {
      add(SlotPlan{.name = "tracks[" + std::to_string(i) + "]"});
      UnitPlan member;
      member.name = "tracker[" + std::to_string(i) + "]";
      member.outputs = {i};
      member.script.step = [](TestUnit& unit, const Tick&) {
        ++unit.memory;
        unit.outputs[0].publish(Item{unit.memory, unit.runtime.gain});
      };
      add(std::move(member));
      reading.inputs.push_back(InputPlan{.slot = i});
    }
    reading.name = "reader";
    add(std::move(reading));
    add(PopulationPlan{.name = "tracker", .first_unit = 0, .capacity = capacity, .active = 2});
    add(ThreadPlan{.name = "tracking",
                   .trigger = TriggerPlan::periodic(milliseconds{1}),
                   .units = {0, 1, 2, 3},
                   .devices = {}});
    add(ThreadPlan{.name = "reading",
                   .trigger = TriggerPlan::periodic(milliseconds{1}, std::chrono::microseconds{500}),
                   .units = {capacity},
                   .devices = {}});
  }
  static constexpr std::uint16_t reader = capacity;
};

ParameterRequest request_to(std::uint16_t member, RequestKind kind) {
  ParameterRequest request;
  request.kind = kind;
  request.component = member;
  return request;
}

ParameterRequest activation(std::uint16_t member, double gain) {
  ParameterRequest request = request_to(member, RequestKind::activate);
  request.add(0, 0, &gain, sizeof(gain));
  return request;
}

void all_are_initialised_and_the_active_ones_step() {
  Population cell;
  Executive executive(cell.application(), in_virtual_time(milliseconds{10}));
  CHECK_EQUAL(run_to_the_end(executive).exit_code, 0);
  for (std::uint16_t i = 0; i < capacity; ++i) {
    CHECK_EQUAL(cell.events().count_of("tracker[" + std::to_string(i) + "]: initialise"), 1U);
    CHECK_EQUAL(cell.unit_state(i).steps > 0, i < 2);
    CHECK_EQUAL(cell.slot_control(i).published() > 0, i < 2);
  }
}

void members_come_and_go_between_steps() {
  Population cell;
  Executive executive(cell.application(), in_virtual_time(milliseconds{60}));
  AnswerQueue answers;
  const std::uint16_t me = executive.cell().add_requester(answers);
  struct Seen {
    NullReason reason;
    Item item;
  };
  std::vector<std::array<Seen, capacity>> seen;
  cell.unit(Population::reader).script.step = [&](TestUnit& unit, const Tick& tick) {
    if (tick.stop_requested) return;
    std::array<Seen, capacity> now{};
    for (std::size_t i = 0; i < capacity; ++i) {
      const View<Item> view = unit.inputs[i].latest();
      now[i] = {view.reason(), view ? *view : Item{}};
    }
    seen.push_back(now);
    const auto send = [&](ParameterRequest request) {
      request.requester = me;
      request.correlation = tick.number;
      executive.cell().send(request);
    };
    if (tick.number == 9) send(activation(2, 5));
    if (tick.number == 19) send(request_to(0, RequestKind::retire));
    if (tick.number == 29) {
      ParameterRequest clone = request_to(3, RequestKind::clone);
      clone.source = 2;
      send(clone);
    }
    if (tick.number == 39) send(request_to(0, RequestKind::activate));
    if (tick.number == 49) send(request_to(0, RequestKind::activate));  // it is already
    if (tick.number == 50) send(request_to(Population::reader, RequestKind::retire));
    if (tick.number == 51) send(request_to(1, RequestKind::retire));
    if (tick.number == 53) send(request_to(1, RequestKind::retire));  // it is already
  };
  CHECK_EQUAL(run_to_the_end(executive).exit_code, 0);
  CHECK_EQUAL(seen.size(), 60U);
  // The table's values, the request's, the cloned member's, the table's again after a reset.
  CHECK_EQUAL(seen[5][1].item.value, 1.0);
  CHECK_EQUAL(seen[5][2].reason, NullReason::writer_retired);
  CHECK_EQUAL(seen[9][2].reason, NullReason::writer_retired);
  CHECK_EQUAL(seen[10][2].reason, NullReason::none);
  CHECK_EQUAL(seen[10][2].item.value, 5.0);
  CHECK_EQUAL(seen[19][0].reason, NullReason::none);
  CHECK_EQUAL(seen[20][0].reason, NullReason::writer_retired);
  CHECK_EQUAL(seen[30][3].item.value, 5.0);
  CHECK_EQUAL(seen[30][3].item.number, 1);
  CHECK_EQUAL(seen[40][0].reason, NullReason::none);
  CHECK_EQUAL(seen[40][0].item.number, 1);
  CHECK_EQUAL(cell.events().count_of("tracker[0]: reset"), 1U);
  CHECK_EQUAL(cell.events().count_of("tracker[0]: initialise"), 1U);
  std::vector<std::uint64_t> refused;
  ParameterAnswer answer;
  while (answers.pop(answer)) {
    if (answer.kind != AnswerKind::accepted) refused.push_back(answer.correlation);
  }
  CHECK((refused == std::vector<std::uint64_t>{49, 50, 53}));
}

void under_load_every_request_is_answered_and_nothing_is_torn() {
  Population cell;
  std::atomic<int> wrong{0};
  std::atomic<std::uint64_t> looks{0};
  cell.thread(0).trigger = TriggerPlan::free_running();
  cell.thread(1).trigger = TriggerPlan::free_running();
  cell.unit(Population::reader).script.step = [&](TestUnit& unit, const Tick&) {
    for (std::size_t i = 0; i < capacity; ++i) {
      const View<Item> view = unit.inputs[i].latest();
      if (view) {
        // Whole numbers from 1 to 9 are all that anybody ever asked for.
        const bool fits = view->value >= 1 && view->value <= 9 && view->number >= 1;
        wrong += fits ? 0 : 1;
      } else if (view.reason() != NullReason::writer_retired && view.reason() != NullReason::nothing_yet) {
        wrong += 1;
      }
    }
    ++looks;
  };
  RunningCell running(cell);
  const std::uint16_t me = running.add_requester();
  running.start();
  CHECK(wait_until([&] { return looks > 100; }));
  const auto ask = [&](ParameterRequest request) {
    request.requester = me;
    const AnswerKind kind = running.ask(request).kind;
    CHECK_EQUAL(kind, AnswerKind::accepted);
  };
  for (int round = 0; round < 150; ++round) {
    ask(activation(2, 1 + round % 9));
    ParameterRequest clone = request_to(3, RequestKind::clone);
    clone.source = 2;
    ask(clone);
    ask(request_to(2, RequestKind::retire));
    ask(request_to(3, RequestKind::retire));
  }
  CHECK_EQUAL(running.finish().exit_code, 0);
  CHECK_EQUAL(wrong.load(), 0);
  CHECK_EQUAL(cell.events().count_of("tracker[3]: reset"), 150U);
  CHECK_EQUAL(cell.events().count_of("tracker[3]: initialise"), 1U);
}

}  // namespace
}  // namespace flexrf::fixture::population_test

int main() {
  using namespace flexrf::fixture::population_test;
  const CMUnitTest tests[] = {
      CONTAINED_TEST(all_are_initialised_and_the_active_ones_step),
      CONTAINED_TEST(members_come_and_go_between_steps),
      CONTAINED_TEST(under_load_every_request_is_answered_and_nothing_is_torn),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
