// Ports of drivers: where they are connected, what is seen through them, and what becomes of those of a
// driver that was not chosen.
#include <cstdlib>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string>

#include "base/quantity_text.hpp"
#include "drivers/model_mover/model_mover.hpp"
#include "drivers/model_scenery/model_scenery.hpp"
#include "drivers/replay_mover/replay_mover.hpp"
#include "drivers/still_mover/still_mover.hpp"
#include "runtime/executive/executive.hpp"
#include "runtime/face/observed_slots.hpp"
#include "runtime/face/slot_readers.hpp"
#include "tests/generator/in_a_process.hpp"
#include "units/helper/helper.hpp"
#include "units/watcher/watcher.hpp"

// CMocka's macros would change what the headers above declare.
#include "tests/cmocka.hpp"

namespace flexrf::application {
extern const Application application;
}

namespace {

using namespace flexrf;
using namespace flexrf::user;
const Application& cell = flexrf::application::application;

template <class Record>
std::uint16_t place_of(std::span<const Record> records, const char* name) {
  for (std::size_t i = 0; i < records.size(); ++i)
    if (std::strcmp(records[i].name, name) == 0) return static_cast<std::uint16_t>(i);
  std::abort();
}
const SlotRecord& slot_named(const char* name) {
  return cell.slots[place_of(cell.slots, name)];
}
const DeviceRecord& mover() {
  return cell.devices[place_of(cell.devices, "mover")];
}

// ---- where they are connected

void a_driver_is_connected_as_the_row_says(void**) {
  const PortBinding& model = *mover().drivers[0].ports;
  const SlotControl* const scene = slot_named("scene").control;
  const SlotControl* const truth = slot_named("truth").control;
  const ThreadRecord& control = cell.threads[place_of(cell.threads, "control")];
  assert_ptr_equal(model.context, control.context);
  assert_int_equal(model.inputs.size(), 3);
  assert_ptr_equal(model.inputs[0].readers->slot(), scene);
  assert_int_equal(model.inputs[0].max_age.count(), 15'000'000);
  assert_ptr_equal(model.inputs[1].readers->slot(), scene);
  assert_ptr_not_equal(model.inputs[1].readers, model.inputs[0].readers);  // what it keeps is its own
  assert_int_equal(model.inputs[2].count, 0);
  assert_int_equal(model.outputs.size(), 1);
  assert_ptr_equal(model.outputs[0], truth);
  assert_int_equal(model.queue_outputs.size(), 1);
  assert_int_equal(model.queue_outputs[0].size(), 1);
  // Another one writes the same slot, and shares the thread's hold on what it reads.
  const PortBinding& replay = *mover().drivers[1].ports;
  assert_ptr_equal(replay.outputs[0], truth);
  assert_ptr_equal(replay.inputs[0].readers, model.inputs[0].readers);
  assert_null(mover().drivers[2].ports);
  assert_int_equal(mover().binding.outputs.size(), 0);
  const DeviceRecord& scenery = cell.devices[place_of(cell.devices, "scenery")];
  assert_ptr_equal(scenery.drivers[0].ports->queue_inputs[0],
                   cell.queues[place_of(cell.queues, "calls")].sources[0]);
  assert_ptr_equal(scenery.drivers[0].ports->context, cell.threads[scenery.thread].context);
}

void its_type_tells_of_them(void**) {
  const std::span<const PortDescriptor> ports = mover().drivers[0].type->ports;
  const char* const names[] = {"scene", "kept", "missing", "truth", "calls"};
  assert_int_equal(ports.size(), std::size(names));
  for (std::size_t i = 0; i < std::size(names); ++i) assert_string_equal(ports[i].name, names[i]);
  assert_true(ports[0].direction == PortDescriptor::Direction::input);
  assert_true(ports[3].direction == PortDescriptor::Direction::output);
  assert_true(ports[4].direction == PortDescriptor::Direction::queue_output);
  assert_int_equal(mover().drivers[2].type->ports.size(), 0);
}

bool text_is(const nlohmann::json& json, const char* wanted) {
  if (json == wanted) return true;
  print_error("%s instead of %s\n", json.dump().c_str(), wanted);
  return false;
}

const nlohmann::json& named(const nlohmann::json& list, const char* key, const char* name) {
  for (const nlohmann::json& one : list)
    if (one.at(key) == name) return one;
  std::abort();
}

void the_descriptor_tells_of_them(void**) {
  static nlohmann::json json;
  json = nlohmann::json::parse(cell.descriptor_json);
  const auto& driver = named(json.at("drivers"), "name", "model_mover");
  assert_true(text_is(driver.at("inputs").at(0).at("name"), "scene"));
  assert_int_equal(driver.at("inputs").at(0).at("max_age_ns").get<int>(), 15'000'000);
  assert_true(text_is(driver.at("outputs").at(1).at("queue"), "WayMark"));
  const auto& device = named(json.at("devices"), "name", "mover");
  assert_true(text_is(device.at("drivers").at(0).at("inputs").at("scene"), "scene"));
  assert_true(device.at("drivers").at(0).at("inputs").at("missing").is_null());
  assert_true(text_is(device.at("drivers").at(1).at("outputs").at("place"), "truth"));
  assert_false(device.at("drivers").at(2).contains("inputs"));
  const auto& truth = named(json.at("slots"), "name", "truth");
  assert_true(text_is(truth.at("writer"), "mover.truth"));
  assert_true(text_is(truth.at("driver_writers").at("model"), "mover.truth"));
  assert_true(text_is(truth.at("driver_writers").at("replay"), "mover.place"));
  assert_int_equal(truth.at("readers").size(), 5);
  const auto& scene = named(json.at("slots"), "name", "scene");
  // Each once, whichever drivers read by it.
  assert_true(scene.at("readers") == nlohmann::json::array({"mover.scene", "mover.kept", "watcher.scene"}));
}

// ---- what is seen through them

/// What was published last in an observed slot; zeros: nothing.
template <class Values>
Values last_in(const char* slot) {
  Values values{};
  SlotReader& observer = *slot_named(slot).observer;
  if (observer.newest() != nullptr && slot_named(slot).control->type()->size == sizeof(values))
    std::memcpy(static_cast<void*>(&values), observer.payload(), sizeof(values));
  return values;
}

/// A virtual second, as "name=value " of what is to be looked at.
std::string seen_with(const char* driver) {
  return in_a_process([driver] {
    Options options;
    options.hardware = {{"mover", driver}};
    options.virtual_time = std::chrono::seconds{1};
    options.audit_file = "off";
    options.digest = true;
    Executive executive(cell, options);
    if (const Status status = executive.prepare(); !status) return std::string(status.cause());
    const RunSummary summary = executive.run();
    std::string text;
    const auto tell = [&text](const char* name, auto value) {
      text += std::string{name} + "=" + std::to_string(value) + " ";
    };
    tell("exit", summary.exit_code);
    tell("published", slot_named("truth").control->published());
    const auto watcher = last_in<WatcherFeedback>("watcher.feedback");
    tell("truths", watcher.truths);
    tell("x", watcher.x);
    tell("delay", watcher.delay);
    tell("reason", static_cast<int>(watcher.reason));
    const auto moved = last_in<MoverFeedback>("mover.feedback");
    tell("scenes", moved.scenes);
    tell("past", moved.past);
    tell("kept", moved.kept);
    const auto scenery = last_in<SceneryFeedback>("scenery.feedback");
    tell("calls", scenery.calls);
    tell("scenery_reason", static_cast<int>(scenery.reason));
    tell("made", slot_named("scene").control->published());
    const auto readers = readers_of_slots(executive.cell());
    for (const SlotInput& reader : readers[place_of(cell.slots, "scene")]) {
      tell(reader.name.c_str(), reader.counters().read);
    }
    for (const char* const helper : {"helper[0].feedback", "helper[1].feedback", "helper[2].feedback"})
      tell(helper, last_in<HelperFeedback>(helper).steps);
    for (const char* const thread : {"looking[0]", "looking[2]"})
      tell(thread, cell.thread_states[place_of(cell.threads, thread)].cycles.load());
    text += "why=" + ObservedSlots(executive.cell())
                         .reason(place_of(cell.slots, "truth"),
                                 ObservedSlots(executive.cell()).read(place_of(cell.slots, "truth")));
    return text + " digest=" + hexadecimal_text(summary.digest.value_or(0));
  });
}

/// Below zero: it is not told.
double number_in(const std::string& text, const char* name) {
  const std::string key = std::string{" "} + name + "=";
  const std::size_t at = (" " + text).find(key);
  if (at != std::string::npos) return std::atof(text.c_str() + at + key.size() - 1);
  print_error("%s is not in: %s\n", name, text.c_str());
  return -1;
}

bool holds(const std::string& text, const char* part) {
  if (text.find(part) != std::string::npos) return true;
  print_error("'%s' is not in: %s\n", part, text.c_str());
  return false;
}

void devices_read_and_write_as_units_do(void**) {
  static std::string seen;
  seen = seen_with("model");
  assert_true(holds(seen, "exit=0 "));
  // One each 5 ms.
  const double published = number_in(seen, "published");
  assert_in_range(published, 200, 210);
  // But for what came when the watcher was stepped no more.
  assert_true(number_in(seen, "truths") >= published - 2);
  assert_true(number_in(seen, "x") == number_in(seen, "truths") - 1);
  // What it publishes when its unit calls it is visible when the unit's budget is over.
  assert_true(number_in(seen, "delay") == 50'000);
  assert_true(number_in(seen, "reason") == 0 && number_in(seen, "scenery_reason") == 0);
  assert_true(number_in(seen, "calls") >= published - 3);
  // One each 10 ms, and some while the cell is brought to rest.
  const double made = number_in(seen, "made");
  assert_in_range(made, 100, 120);
  assert_in_range(number_in(seen, "scenes"), 98, made);
  assert_in_range(number_in(seen, "kept"), 98, made);
  assert_in_range(number_in(seen, "past"), 96, made - 1);
  // Reports ask them as units.
  assert_true(number_in(seen, "mover.scene") == number_in(seen, "scenes"));
  assert_in_range(number_in(seen, "mover.kept"), 98, made);
  assert_true(holds(seen, "why=writer stopped "));
}

void another_driver_may_write_the_same(void**) {
  static std::string seen;
  seen = seen_with("replay");
  assert_true(holds(seen, "exit=0 "));
  assert_true(number_in(seen, "published") >= 200);
  assert_true(number_in(seen, "x") == -1);
  assert_true(number_in(seen, "delay") == 1'000);  // published in receive()
  assert_true(number_in(seen, "calls") == 0);
  assert_true(number_in(seen, "mover.scene") >= 98);
  assert_true(seen.find("mover.kept") == std::string::npos);
  assert_true(holds(seen, "why=writer stopped "));
}

// [board-45]
void what_a_driver_that_was_not_chosen_would_write_is_null_with_the_reason(void**) {
  static std::string seen;
  seen = seen_with("still");
  assert_true(holds(seen, "exit=0 "));
  assert_true(number_in(seen, "published") == 0);
  assert_true(number_in(seen, "reason") == static_cast<int>(NullReason::driver_not_chosen));
  assert_true(number_in(seen, "scenery_reason") == static_cast<int>(NullReason::driver_not_chosen));
  assert_true(seen.find("mover.scene") == std::string::npos);
  assert_true(number_in(seen, "watcher.scene") >= 0);
  assert_true(holds(
      seen, "why=written by drivers 'model' and 'replay' of device 'mover', none of which was chosen "));
}

// ---- each = "helper"

void each_member_has_a_thread_as_the_row_says(void**) {
  for (std::size_t member = 0; member < 3; ++member) {
    const std::string name = "looking[" + std::to_string(member) + "]";
    const std::uint16_t place = place_of(cell.threads, name.c_str());
    const ThreadRecord& thread = cell.threads[place];
    assert_int_equal(thread.units.size(), 1);
    const UnitRecord& unit = cell.units[thread.units[0]];
    assert_int_equal(unit.member, member);
    assert_int_equal(unit.thread, place);
    assert_ptr_equal(unit.binding.context, thread.context);
    assert_true(thread.trigger.kind == TriggerKind::backoff);
    assert_int_equal(thread.trigger.longest.count(), 20'000'000);
    assert_ptr_equal(thread.trigger.sources[0].slot, slot_named("truth").control);
    assert_int_equal(thread.stack_size, 64 * 1024 + page);
  }
}

void each_member_is_released_by_itself(void**) {
  static std::string seen;
  seen = seen_with("model");
  assert_true(number_in(seen, "helper[0].feedback") > 150);
  assert_true(number_in(seen, "helper[1].feedback") > 150);
  assert_true(number_in(seen, "helper[2].feedback") == 0);  // it rests
  assert_true(number_in(seen, "looking[0]") > 150);
  assert_true(number_in(seen, "looking[2]") > 150);
}

void two_runs_are_the_same(void**) {
  static std::string first, again;
  for (const char* const driver : {"model", "replay"}) {
    first = seen_with(driver);
    again = seen_with(driver);
    assert_string_equal(first.c_str(), again.c_str());
  }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_driver_is_connected_as_the_row_says),
      cmocka_unit_test(its_type_tells_of_them),
      cmocka_unit_test(the_descriptor_tells_of_them),
      cmocka_unit_test(devices_read_and_write_as_units_do),
      cmocka_unit_test(another_driver_may_write_the_same),
      cmocka_unit_test(what_a_driver_that_was_not_chosen_would_write_is_null_with_the_reason),
      cmocka_unit_test(each_member_has_a_thread_as_the_row_says),
      cmocka_unit_test(each_member_is_released_by_itself),
      cmocka_unit_test(two_runs_are_the_same)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
