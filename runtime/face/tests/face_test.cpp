// What every outsider of a cell shares: finding by name, looking at slots, making requests of what is
// written.
#include <cstddef>
#include <cstring>
#include <functional>
#include <optional>

#include "base/quantity_text.hpp"
#include "runtime/blackboard/job_queue.hpp"
#include "runtime/face/change.hpp"
#include "runtime/face/component_values.hpp"
#include "runtime/face/json_parts.hpp"
#include "runtime/face/statistics.hpp"

// CMocka's macros would change what the headers above declare.
#include "runtime/executive/tests/running_cell.hpp"

namespace flexrf::fixture {
namespace {

using Cell = ProducerAndConsumer;

/// A cell that was prepared and does not run: the test is the writer.
struct Still {
  Still() : running(cell) {
    directory.emplace(inside());
    slots.emplace(inside());
    values.emplace(inside(), *directory, *slots);
  }
  const flexrf::Cell& inside() { return running.executive().cell(); }
  SlotControl& control() { return cell.slot_control(Cell::values); }
  void publish(std::int64_t number) {
    const std::uint8_t buffer = control().loan();
    const Item item{number, 0.5};
    std::memcpy(control().payload(buffer), &item, sizeof(item));
    control().publish(buffer, Time{Duration{number}});
  }
  const ObservedSlot& look() { return slots->read(Cell::values); }
  static std::int64_t number_in(const ObservedSlot& seen) {
    return static_cast<const Item*>(seen.value)->number;
  }
  const ComponentEntry& producer() { return directory->entry(Cell::producer); }

  Cell cell;
  RunningCell running;
  std::optional<Directory> directory;
  std::optional<ObservedSlots> slots;
  std::optional<ComponentValues> values;
};

void things_are_found_by_name_and_the_nearest_is_named() {
  Still cell;
  CHECK_EQUAL(*cell.directory->component("producer"), Cell::producer);
  CHECK_EQUAL(*cell.directory->component("actuator"), cell.cell.application().devices[0].index);
  CHECK(!cell.directory->component("produce"));
  CHECK_EQUAL(*cell.directory->slot("values"), Cell::values);
  CHECK(!cell.directory->slot(""));
  const Refusal refusal = cell.directory->no_slot("valeus");
  CHECK_EQUAL(refusal.kind(), RefusalKind::not_found);
  CHECK_EQUAL(std::string{refusal.text()}, "There is no slot 'valeus'");
  CHECK_EQUAL(std::string{refusal.hint()}, "did you mean 'values'?");
  CHECK_EQUAL(std::string{refusal.detail()}, "There is no slot 'valeus'; did you mean 'values'?");
  CHECK_EQUAL(std::string{cell.directory->no_component("x").detail()},
              "There is no unit or device 'x'; descriptor.json has the names.");
  CHECK_EQUAL(*cell.directory->find(Part::queue, "jobs"), Cell::jobs);
  CHECK_EQUAL(*cell.directory->find(Part::thread, "consuming"), Cell::consuming);
  CHECK(!cell.directory->find(Part::thread, "jobs"));
  CHECK_EQUAL(std::string{cell.directory->unknown(Part::thread, "consumin").detail()},
              "There is no thread 'consumin'; did you mean 'consuming'?");
  CHECK_EQUAL(std::string{cell.directory->unknown(Part::queue, "consuming").detail()},
              "There is no queue 'consuming'; descriptor.json has the names.");
}

void a_slot_is_read_once_in_a_turn_with_the_reason_when_there_is_nothing() {
  Still cell;
  CHECK_EQUAL(cell.look().reason, NullReason::nothing_yet);
  CHECK(cell.look().value == nullptr && cell.look().last == nullptr);
  cell.publish(5);
  CHECK_EQUAL(cell.look().reason, NullReason::nothing_yet);  // in this turn
  for (std::int64_t number = 6; number < 20; ++number) {
    cell.publish(number);
    cell.slots->begin_turn();
    CHECK_EQUAL(cell.look().reason, NullReason::none);
    CHECK_EQUAL(Still::number_in(cell.look()), number);
    CHECK_EQUAL(cell.look().header.sequence, static_cast<std::uint64_t>(number) - 4);
    CHECK_EQUAL(nanoseconds(cell.look().header.sampled_at), number);
  }
  cell.control().set_writer_state(WriterState::faulted);
  cell.slots->begin_turn();
  CHECK_EQUAL(cell.look().reason, NullReason::writer_faulted);
  CHECK(cell.look().value == nullptr);
  CHECK_EQUAL(cell.look().header.sequence, 15U);  // when it was last, and what, is still known
  CHECK_EQUAL(static_cast<const Item*>(cell.look().last)->number, 19);
}

void a_slot_that_is_not_observed_says_so() {
  Cell cell;
  cell.slot(Cell::values).observe = false;
  RunningCell running(cell);
  ObservedSlots slots(running.executive().cell());
  CHECK_EQUAL(slots.read(Cell::values).reason, NullReason::not_registered);
  CHECK(slots.read(Cell::values).value == nullptr);
}

/// A cell that has run: its producer failed, its consumer did not empty the queue.
struct Ended {
  Ended() {
    cell.queue(Cell::jobs).capacity = 4;
    cell.unit(Cell::producer).script.step = [this](TestUnit& unit, const Tick& tick) {
      make_and_push(unit, tick);
      unit.restrain("slippery", 3, 2);
      if (tick.number == 9) unit.fail(Status::error(StatusCode::device_fault, "slipped"));
    };
    cell.unit(Cell::consumer).script.step = [](TestUnit& unit, const Tick&) { unit.inputs[0].latest(); };
    executive.emplace(cell.application(), in_virtual_time(std::chrono::milliseconds{50}));
    CHECK(executive->prepare().is_ok());
    executive->run();
  }
  flexrf::Cell& inside() { return executive->cell(); }

  Cell cell;
  std::function<void(TestUnit&, const Tick&)> make_and_push = cell.unit(Cell::producer).script.step;
  std::optional<Executive> executive;
};

void what_is_counted_is_had_of_each_part() {
  Ended ended;
  const Statistics statistics(ended.inside());
  const ComponentFigures producer = statistics.component(Cell::producer);
  CHECK_EQUAL(producer.life, Life::fault);
  CHECK_EQUAL(std::string{producer.fault.cause()}, "slipped");
  CHECK_EQUAL(producer.steps, 10U);
  CHECK_EQUAL(producer.restraints, 1U);
  CHECK_EQUAL(std::string{RestraintText(producer.restraint).text}, "slippery: 3 was asked for, 2 is done");
  CHECK(producer.population == nullptr);
  CHECK_EQUAL(std::string{producer.driver}, "");
  CHECK_EQUAL(std::string{producer.record->kind}, "unit");
  const ComponentFigures actuator =
      statistics.component(ended.cell.application().devices[Cell::actuator].index);
  CHECK_EQUAL(std::string{actuator.driver}, "mock");
  CHECK_EQUAL(std::string{actuator.record->kind}, "device");
  CHECK(actuator.fault.is_ok() && actuator.active);
  CHECK_EQUAL(actuator.steps, 0U);

  const ThreadFigures producing = statistics.thread(Cell::producing);
  CHECK_EQUAL(std::string{producing.record->name}, "producing");
  CHECK(producing.cycles >= producer.steps);

  CHECK(producing.step_began == Time{});

  const SlotFigures values = statistics.slot(Cell::values);
  CHECK_EQUAL(std::string{values.record->name} + " " + values.type->name, "values Item");
  CHECK_EQUAL(values.published, 10U);
  CHECK_EQUAL(values.readers.size(), 1U);
  const SlotInput& reader = values.readers[0];
  CHECK_EQUAL(reader.name, "consumer.first");
  // But for the last, which came from a step that failed.
  CHECK_EQUAL(reader.counters().read, 9U);
  CHECK_EQUAL(reader.counters().missed, 0U);

  const QueueFigures jobs = statistics.queue(Cell::jobs);
  CHECK_EQUAL(jobs.writer_count(), 1U);
  CHECK_EQUAL(jobs.fill, 4U);
  const auto [name, counters] = jobs.writer(0);
  CHECK_EQUAL(std::string{name}, "producer.orders");
  CHECK_EQUAL(counters.pushed, 4U);
  CHECK_EQUAL(counters.dropped, 6U);
  CHECK_EQUAL(counters.popped, 0U);
}

std::string written(const QueueRecord& record) {
  QueueFigures figures{&record, 0};
  if (figures.source() != nullptr) figures.fill = figures.source()->fill();
  JsonWriter json{std::string{}};
  json.begin_object();
  write_queue(json, figures);
  json.end_object();
  return json.release();
}

void a_queue_by_score_tells_what_waits_in_it() {
  constexpr std::size_t many = most_scores + 6;
  JobQueueMemory<Item, many> memory{};
  const JobOrder order{true, Scalar::f64, offsetof(Item, value)};
  JobQueue queue{&item_type, memory.view(), DropPolicy::drop_newest, order};
  JobSink sink{&queue};
  QueueSink* const sinks[] = {&sink};
  const char* const writers[] = {"one.orders"};
  QueueSource* const sources[] = {&queue};
  const char* const readers[] = {"two.orders"};
  const QueueRecord record{"jobs", "", &item_type, many, sinks, writers, sources, readers, false};
  CHECK_CONTAINS(written(record), R"("capacity":70,"fill":0,"scores":[],"writers":[{"name":"one.orders")");
  for (const double level : {0.25, 2.0, -1.0}) {
    const Item item{1, level};
    CHECK(sink.push(&item, Time{}));
  }
  CHECK_CONTAINS(written(record), R"("fill":3,"scores":[2,0.25,-1],"writers")");
  for (int level = 3; level < static_cast<int>(most_scores) + 6; ++level) {
    const Item item{1, static_cast<double>(level)};
    CHECK(sink.push(&item, Time{}));
  }
  // All are counted; the highest are told.
  const std::string full = written(record);
  CHECK_CONTAINS(full, R"("fill":70,"scores":[69,68,)");
  CHECK_CONTAINS(full, R"(,7,6],"writers")");

  JobQueue unordered{&item_type, memory.view(), DropPolicy::drop_newest};
  QueueSource* const others[] = {&unordered};
  const QueueRecord other{"jobs", "", &item_type, many, {}, {}, others, readers, false};
  CHECK(written(other).find("scores") == std::string::npos);
  const QueueRecord unread{"jobs", "", &item_type, many, {}, {}, {}, {}, false};
  CHECK_CONTAINS(written(unread), R"("fill":0,"writers":[],"readers":[])");
}

template <class Range, class Name>
std::string names_of(const Range& range, const Name& name) {
  std::string names;
  for (const auto& figures : range) names += std::string{name(figures)} + " ";
  return names;
}

void all_of_a_kind_come_in_the_order_of_their_table() {
  Ended ended;
  const Statistics statistics(ended.inside());
  const auto name = [](const auto& figures) { return figures.record->name; };
  CHECK_EQUAL(names_of(statistics.units(), name), "producer consumer ");
  CHECK_EQUAL(names_of(statistics.devices(), name), "actuator ");
  CHECK_EQUAL(names_of(statistics.queues(), name), "jobs ");
  const Directory directory(ended.inside());
  const auto own_name = [](const auto& record) { return record.name; };
  CHECK_EQUAL(names_of(statistics.slots(), name), names_of(directory.slots(), own_name));
  CHECK_EQUAL(names_of(directory.queues(), own_name), "jobs ");
  CHECK_EQUAL(names_of(directory.threads(), own_name), "producing consuming ");
  for (const SlotFigures& slot : statistics.slots())
    CHECK_EQUAL(*directory.slot(slot.record->name), slot.index);

  const DeviceFigures actuator = statistics.device(Cell::actuator);
  CHECK_EQUAL(std::string{actuator.unit} + ", " + actuator.bus + ", " + actuator.thread,
              "consumer, , consuming");
  CHECK_EQUAL(actuator.chosen->kind, DriverKind::mock);
}

void restraints_have_one_wording() {
  CHECK_EQUAL(std::string{RestraintText({}).text}, "");
  CHECK_EQUAL(std::string{RestraintText({.reason = "it is homed"}).text}, "it is homed");
  const std::string longest(300, 'x');
  const std::string cut = RestraintText({longest.c_str(), -1234567, 0.000012345678}).text;
  CHECK_EQUAL(cut, std::string(140, 'x') + ": -1.23457e+06 was asked for, 1.23457e-05 is done");
}

void what_is_not_saved_has_one_wording() {
  const Status full = Status::error(StatusCode::unavailable, "no room");
  const Refusal failed = not_saved(RefusalKind::not_stored, full);
  CHECK_EQUAL(failed.kind(), RefusalKind::not_stored);
  CHECK_EQUAL(std::string{failed.detail()},
              "The values were not saved: no room; they are in force all the same.");
  CHECK_EQUAL(std::string{failed.reason()}, "no room");
  CHECK_EQUAL(std::string{no_answer_of_disk(std::chrono::seconds{10}).detail()},
              "The disk of the configuration file did not answer within 10 s; the state says when the values "
              "are saved.");
  CHECK_EQUAL(std::string{saving_already().detail()},
              "The values are being saved already; wait until that is done.");
}

void what_is_in_fault_has_its_place() {
  Ended ended;
  const FaultPlaces places(ended.inside());
  CHECK_EQUAL(places.count(), 3U + 2U + 1U);
  for (std::size_t place = 0; place < places.count(); ++place)
    CHECK_EQUAL(places.extent(place) != 0, place == Cell::producer);
  const FaultPlaces::Fault fault = places.at(Cell::producer);
  CHECK_EQUAL(std::string{fault.kind} + " " + fault.name + ": " + fault.cause, "unit producer: slipped");
  CHECK_EQUAL(fault.who, "producer");

  ended.cell.application().thread_states[Cell::consuming].longest_standstill = 2'000'000;
  ended.inside().control().note_standstill(std::chrono::seconds{3});
  CHECK_EQUAL(places.extent(places.thread(Cell::consuming)), 2'000'000);
  const FaultPlaces::Fault thread = places.at(places.thread(Cell::consuming));
  CHECK_EQUAL(std::string{thread.kind} + " " + thread.name + ": " + thread.cause,
              "thread consuming: stood still for " + duration_text(std::chrono::milliseconds{2}));
  CHECK_EQUAL(thread.who, "thread consuming");
  const FaultPlaces::Fault hanging = places.hanging(Cell::consuming);
  CHECK_EQUAL(hanging.who + ": " + hanging.cause, "thread consuming: its step does not return");
  const FaultPlaces::Fault process = places.at(places.process());
  CHECK_EQUAL(std::string{process.kind} + " " + process.name + ": " + process.cause,
              "process test_cell: stood still for " + duration_text(std::chrono::seconds{3}));
  CHECK_EQUAL(process.who, "process test_cell");
}

void configuration_is_known_before_anything_runs() {
  Still cell;
  JsonWriter json;
  cell.values->write_configuration(json, Cell::producer);
  CHECK_CONTAINS(json.take(), "\"offset\"");
}

template <class Add>
std::optional<Refusal> added(Still& cell, std::string_view text, ParameterRequest& request, Role& role,
                             const Add& add) {
  JsonReader reader;
  const Result<JsonObject> object = reader.object(text);
  CHECK(static_cast<bool>(object));
  return add(cell.producer(), *object, request, role);
}

void what_is_written_becomes_a_request_or_is_refused_in_one_wording() {
  Still cell;
  const auto set = [&cell](std::string_view text) {
    ParameterRequest request;
    Role role = Role::viewer;
    const auto refusal = added(cell, text, request, role, add_values);
    if (!refusal) CHECK_EQUAL(request.change_count, 1U);
    return refusal ? std::string{refusal->detail()} : std::string{};
  };
  CHECK_EQUAL(set(R"({"gain": 2.5})"), "");
  CHECK_EQUAL(set(R"({"gian": 2.5})"), "producer has no runtime parameter 'gian'; did you mean 'gain'?");
  CHECK_CONTAINS(set(R"({"gain": 11})"), "producer.gain is refused: ");
  CHECK_EQUAL(set("{}"), "There is no value; write {\"PATH\": value, ...}.");

  const auto press = [&cell](std::string_view path, std::uint64_t count) {
    ParameterRequest request;
    Role role = Role::viewer;
    const auto refusal = add_presses(cell.producer(), path, count, request, role);
    CHECK_EQUAL(request.kind == RequestKind::press, !refusal);
    return refusal ? std::string{refusal->detail()} : std::string{};
  };
  CHECK_EQUAL(press("kick", 100), "");
  CHECK_EQUAL(press("kick", 0), "'count' lies from 1 to 100.");
  CHECK_EQUAL(press("kick", 101), "'count' lies from 1 to 100.");
  CHECK_EQUAL(press("move", 1),
              "producer.move cannot be pressed: it is no button; only a person who watches can hold it.");
  ParameterRequest hold;
  hold.kind = RequestKind::hold;
  Role role = Role::viewer;
  CHECK(!add_name(cell.producer(), "move", hold, role));
  const auto refusal = add_name(cell.producer(), "gain", hold, role);
  CHECK(refusal.has_value());
  CHECK_CONTAINS(std::string{refusal->detail()}, "producer.gain cannot be held: it is no hold parameter");
}

}  // namespace
}  // namespace flexrf::fixture

int main() {
  using namespace flexrf::fixture;
  const CMUnitTest tests[] = {
      CONTAINED_TEST(things_are_found_by_name_and_the_nearest_is_named),
      CONTAINED_TEST(a_slot_is_read_once_in_a_turn_with_the_reason_when_there_is_nothing),
      CONTAINED_TEST(a_slot_that_is_not_observed_says_so),
      CONTAINED_TEST(what_is_counted_is_had_of_each_part),
      CONTAINED_TEST(a_queue_by_score_tells_what_waits_in_it),
      CONTAINED_TEST(all_of_a_kind_come_in_the_order_of_their_table),
      CONTAINED_TEST(restraints_have_one_wording),
      CONTAINED_TEST(what_is_not_saved_has_one_wording),
      CONTAINED_TEST(what_is_in_fault_has_its_place),
      CONTAINED_TEST(configuration_is_known_before_anything_runs),
      CONTAINED_TEST(what_is_written_becomes_a_request_or_is_refused_in_one_wording),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
