// The resolved model: readers, doorbells, queues, devices, layouts, values, memory, and a large application.
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <map>

#include "config-gen/model/memory.hpp"
#include "config-gen/model/ports.hpp"
#include "config-gen/tests/find.hpp"
#include "config-gen/tests/tables.hpp"
#include "places.hpp"
#include "tests/cmocka.hpp"

namespace flexrf::config_gen::tests::model_test {
namespace {

const Result& cell(const std::string& name) {
  static std::map<std::string, Result> results;
  std::filesystem::current_path(place::tests_folder);
  if (!results.contains(name)) results.emplace(name, read_cell("cells/" + name));
  return results.at(name);
}

void the_keyboard_example(void**) {
  const Result& result = cell("keyboard");
  assert_string_equal(result.messages.c_str(), "");
  const Model& model = result.model;
  assert_int_equal(model.threads.size(), 3);
  assert_string_equal(model.threads[2].name.c_str(), "keyboard");
  assert_true(model.devices[0].io_thread == std::size_t{2});
  assert_true(model.devices[1].thread == index_of(model.threads, "control"));
  assert_true(model.devices[1].owner_unit == index_of(model.units, "robot"));
  assert_int_equal(named(model.threads, "control").response_time.value_or(0), 300'000);
  const Queue& keys = named(model.queues, "keys");
  assert_int_equal(keys.writers.size(), 1);
  assert_int_equal(keys.readers.size(), 1);
  assert_int_equal(keys.doorbells.size(), 1);
  const Slot& target = named(model.slots, "target");
  assert_int_equal(target.reader_count, 2);  // the control thread and the observer
  assert_int_equal(target.buffers(), 4);
  assert_true(has(model.slots, "jog.feedback") && has(model.slots, "jog.values") &&
              has(model.slots, "arm.values"));
  assert_false(has(model.slots, "robot.feedback"));
}

// As it lies in its package, with what the row adds.
void a_downloaded_robot(void**) {
  const Result& result = cell("downloaded");
  assert_string_equal(result.messages.c_str(), "");
  const DeviceResource& robot = named(result.model.devices, "arm").resources[0];
  assert_true(robot.chain.has_value());
  const std::vector<UrdfJoint>& joints = robot.chain->joints;
  assert_int_equal(joints.size(), 2);
  assert_true(joints[0].kind == UrdfJoint::Kind::continuous);
  assert_true(joints[0].acceleration == 4.0 && joints[0].jerk == 40.0 && joints[0].home == 0.5);
  assert_true(joints[1].kind == UrdfJoint::Kind::prismatic);
  assert_true(joints[1].lower == 0.0 && joints[1].upper == 0.4 && joints[1].velocity == 1.0);
  assert_true(robot.chain->tool.position[0] == 0.1);
  std::string files;
  for (const PanelFile& file : result.model.panel.files)
    files += file.path + " from " + file.file.generic_string() + "\n";
  assert_string_equal(
      files.c_str(),
      "robots/arm.urdf from cells/downloaded/ros/arm_description/urdf/arm.urdf\n"
      "robots/packages/arm_description/meshes/visual/base.stl from "
      "cells/downloaded/ros/arm_description/meshes/visual/base.stl\n"
      "meshes/visual/column.stl from cells/downloaded/ros/arm_description/meshes/visual/column.stl\n"
      "robots/packages/hand_description/meshes/hand.stl from "
      "cells/downloaded/models/hand_description/meshes/hand.stl\n");
}

void values_override_defaults(void**) {
  const Model& model = cell("keyboard").model;
  const Unit& jog = named(model.units, "jog");
  assert_true(std::get<double>(jog.runtime[0].value) == 0.02);
  assert_int_equal(jog.configuration[0].elements.size(), 3);
  for (const Literal& axis : jog.configuration[0].elements) assert_true(std::get<double>(axis.value) == 0.5);
  const Device& arm = named(model.devices, "arm");
  assert_true(std::get<double>(arm.runtime[0].value) == 0.25);
  assert_true(std::get<double>(arm.drivers[0].configuration[0].value) == 0.001);
  assert_string_equal(arm.resources[0].file.generic_string().c_str(), "cells/keyboard/six-axis.urdf");
}

void layouts_are_those_of_the_compiler(void**) {
  struct KeyEvent {
    std::uint32_t key;
    std::uint8_t action;
    char source[16];
  };
  const Model& model = cell("keyboard").model;
  const Type& type = named(model.types, "KeyEvent");
  assert_int_equal(type.size, sizeof(KeyEvent));
  assert_int_equal(type.alignment, alignof(KeyEvent));
  assert_int_equal(type.fields[2].offset, offsetof(KeyEvent, source));
  assert_int_equal(named(model.types, "Pose").size, 56);
}

void readers_are_threads_and_holds(void**) {
  const Model& model = cell("shared").model;
  assert_string_equal(cell("shared").messages.c_str(), "");
  const Slot& picture = named(model.slots, "picture");  // four held inputs, no observer, three loans
  assert_int_equal(picture.readers.size(), 4);
  assert_int_equal(picture.reader_count, 8);
  assert_int_equal(picture.readers[3].first, 6);
  assert_int_equal(picture.buffers(), 8 + 1 + 3);
  const Slot& mean = named(model.slots, "mean");  // three units of one thread: one buffer
  assert_int_equal(mean.inputs.size(), 3);
  assert_int_equal(mean.readers.size(), 2);
  assert_true(mean.readers[1].kind == SlotReader::Kind::observer);
  assert_int_equal(mean.history, 32);
}

void populations_make_arrays(void**) {
  const Model& model = cell("shared").model;
  assert_int_equal(model.populations.size(), 1);
  assert_int_equal(model.populations[0].capacity, 4);
  assert_true(named(model.units, "tracker[1]").active);
  assert_false(named(model.units, "tracker[2]").active);
  const Unit& fusion = named(model.units, "fusion");
  assert_int_equal(fusion.inputs[0].slots.size(), 4);
  assert_string_equal(model.slots[fusion.inputs[0].slots[3]].name.c_str(), "tracks[3]");
  const std::size_t jobs = index_of(model.threads, "jobs");
  assert_int_equal(named(model.slots, "tracks[2]").doorbells[0], jobs);
}

// By a row that names a row that names another one; a list may be shorter than its array.
void a_value_that_rows_share_stands_once(void**) {
  const Model& model = cell("given-once").model;
  assert_string_equal(cell("given-once").messages.c_str(), "");
  const Position& written = named(model.units, "third").configuration[0].position;
  for (const char* const name : {"first", "second", "third"}) {
    const Literal& boxes = named(model.units, name).configuration[0];
    assert_true(boxes.position == written);
    assert_int_equal(boxes.elements.size(), 4);
    const std::array<std::int64_t, 4> numbers{7, 8, 0, 0};
    for (std::size_t i = 0; i < numbers.size(); ++i)
      assert_int_equal(std::get<std::int64_t>(boxes.elements[i].elements[1].value), numbers[i]);
    assert_true(std::get<double>(boxes.elements[0].elements[0].elements[1].value) == 0.1);
  }
  assert_int_equal(std::get<std::int64_t>(named(model.units, "first").configuration[1].value), 3);
  assert_int_equal(std::get<std::int64_t>(named(model.units, "third").configuration[1].value), 5);
}

void copies_are_queues_of_their_own(void**) {
  const Model& model = cell("shared").model;
  assert_int_equal(model.queues.size(), 2);
  assert_string_equal(model.queues[0].name.c_str(), "jobs@worker.jobs");
  assert_string_equal(model.queues[1].name.c_str(), "jobs@second_worker.jobs");
  assert_int_equal(model.queues[1].writers.size(), 2);
  assert_int_equal(named(model.units, "planner").outputs[0].queues.size(), 2);
  assert_true(named(model.units, "second_worker").inputs[0].queue == std::size_t{1});
  assert_int_equal(model.queues[0].doorbells.size(), 0);  // its reader's thread is periodic
  assert_int_equal(model.queues[1].doorbells.size(), 1);
}

void children_come_before_buses(void**) {
  const Model& model = cell("axes").model;
  assert_int_equal(model.safe_order.size(), model.devices.size());
  assert_int_equal(model.safe_order.back(), index_of(model.devices, "can0"));
}

void memory_adds_up(void**) {
  const Model& model = cell("shared").model;
  const std::vector<MemoryItem> items = memory_map(model);
  std::size_t picture = 0;
  for (const MemoryItem& item : items)
    if (item.kind == MemoryItem::Kind::slot && item.name == "picture") picture = item.bytes;
  const std::size_t payload = named(model.slots, "picture").payload_size;
  assert_true(picture >= 12 * payload && picture < 12 * payload + 12 * 2 * page);
  assert_true(total(items) > picture);
}

// The driver is chosen at the start: what is read by the interface's struct lies at the same place with each.
void values_of_a_driver_lie_behind_its_interfaces(void**) {
  struct Feedback {
    double share;
    bool known;
  };
  struct All {
    Feedback shared;
    bool warm;
    double heat;
  };
  const Model& model = cell("own-values").model;
  assert_string_equal(cell("own-values").messages.c_str(), "");
  const Driver& plain = named(model.drivers, "plain");
  const Driver& smart = named(model.drivers, "smart");
  assert_true(plain.runtime.empty() && plain.feedback.empty());
  assert_int_equal(smart.feedback.parameters[0].field.offset, offsetof(All, warm));
  assert_int_equal(smart.feedback.parameters[1].field.offset, offsetof(All, heat));
  assert_int_equal(smart.feedback.size, sizeof(All));
  assert_int_equal(smart.feedback.alignment, alignof(All));
  const Slot& feedback = named(model.slots, "valve.feedback");
  assert_true(feedback.type.kind == SlotType::Kind::driver_feedback);
  assert_int_equal(feedback.payload_size, sizeof(All));
  assert_int_equal(named(model.slots, "valve.values").payload_size, 16);
  const Device& valve = named(model.devices, "valve");
  assert_int_equal(valve.drivers[0].runtime.size(), 0);
  assert_int_equal(std::get<std::int64_t>(valve.drivers[1].runtime[0].value), 3);
  assert_true(smart.runtime.parameters[1].needs[0].of == Need::Of::feedback);
  assert_int_equal(valve.overrides.size(), 2);
  assert_true(valve.overrides[0].kind == Parameter::Kind::runtime);
  assert_true(valve.overrides[1].kind == Parameter::Kind::feedback);
  assert_string_equal(model.panel.widgets[0].parameters[0].second.c_str(), "valve.feedback.heat");
  assert_string_equal(model.panel.widgets[1].parameters[0].second.c_str(), "valve.dither");
  assert_string_equal(model.renames[0].to.c_str(), "valve.dither");
}

// As those of units, in groups too. Of two drivers of one device one is chosen: they share slots and copies.
void ports_of_drivers_connect_as_those_of_units(void**) {
  const Model& model = cell("driver-ports").model;
  assert_string_equal(cell("driver-ports").messages.c_str(), "");
  const Device& servo = named(model.devices, "axis[1].servo");
  const Index truth = index_of(model.slots, "truths[1]");
  assert_true(servo.drivers[0].outputs[0].slot == truth);
  assert_true(servo.drivers[1].outputs[0].slot == truth);
  assert_int_equal(writers_of(model, truth).size(), 2);
  assert_int_equal(model.slots[truth].loans, 3);
  assert_int_equal(model.slots[truth].reader_count, 2);  // the main thread and the observer
  const Slot& scene = named(model.slots, "scene");
  assert_int_equal(scene.inputs.size(), 2);
  assert_int_equal(scene.readers.size(), 3);  // the threads of both axes and the observer
  assert_true(scene.readers[1].thread == index_of(model.threads, "axis[1].control"));
  assert_true(named(model.slots, "axis[1].position").readers[0].kind == SlotReader::Kind::held_input);
  assert_int_equal(named(model.slots, "axis[1].position").reader_count, 3);
  assert_int_equal(model.queues.size(), 2);
  assert_string_equal(model.queues[1].name.c_str(), "orders@axis[1].servo.orders");
  assert_int_equal(model.queues[1].readers.size(), 2);
  assert_int_equal(readers_at_work(model.queues[1]).size(), 1);
  assert_true(servo.drivers[0].inputs[2].queue == Index{1} && servo.drivers[1].inputs[0].queue == Index{1});
  assert_int_equal(named(model.units, "planner").outputs[0].queues.size(), 2);
}

// each = "tracker": all that the row says holds for each of them.
void members_have_threads_of_their_own(void**) {
  const Model& model = cell("members").model;
  assert_string_equal(cell("members").messages.c_str(), "");
  const char* const names[] = {"tracker[0]",   "tracker[1]",       "tracker[2]",
                               "worker[0]",    "worker[1]",        "main",
                               "left",         "around[0]",        "around[1]",
                               "eyes[0].main", "eyes[0].right[0]", "eyes[0].right[1]",
                               "eyes[1].main", "eyes[1].right[0]", "eyes[1].right[1]"};
  assert_int_equal(model.threads.size(), std::size(names));
  for (const char* const name : names) assert_true(has(model.threads, name));
  for (std::size_t member = 0; member < 3; ++member) {
    const std::string name = "tracker[" + std::to_string(member) + "]";
    const Index index = index_of(model.threads, name);
    const Thread& thread = model.threads[index];
    assert_int_equal(thread.units.size(), 1);
    assert_int_equal(thread.units[0], index_of(model.units, name));
    assert_true(model.units[thread.units[0]].thread == index);
    assert_int_equal(thread.priority, 5);
    assert_int_equal(thread.deadline.value_or(0), 10'000'000);
    assert_true(thread.overrun.policy == Overrun::Policy::fault);
    assert_int_equal(thread.stack, 64 * 1024);
    assert_int_equal(thread.demand, 100'000);
    assert_string_equal(thread.summary.c_str(), "Looks for one thing.");
    const std::vector<Index>& bells = named(model.slots, "picture").doorbells;
    assert_true(std::find(bells.begin(), bells.end(), index) != bells.end());
  }
  // As they are served one after the other.
  assert_int_equal(named(model.threads, "tracker[2]").response_time.value_or(0), 300'000);
  assert_true(std::holds_alternative<BackoffTrigger>(named(model.threads, "worker[1]").trigger));
  assert_true(named(model.units, "eyes[1].left[0]").thread == index_of(model.threads, "around[0]"));
  assert_true(named(model.units, "eyes[0].right[1]").thread == index_of(model.threads, "eyes[0].right[1]"));
}

// 1000 units with two slots each, in ten threads.
std::string large_table() {
  std::string text = "summary = \"Large.\"\nmemory_budget = \"64 MiB\"\n";
  for (int i = 0; i < 1000; ++i) {
    const std::string number = std::to_string(i);
    text += "[unit.u" + number + "]\ntype = \"twin\"\nin.left = \"a" + std::to_string((i + 999) % 1000) +
            "\"\nin.right = \"b" + std::to_string((i + 1) % 1000) + "\"\nout.first = \"a" + number +
            "\"\nout.second = \"b" + number + "\"\nbudget = \"1 us\"\n";
  }
  for (int thread = 0; thread < 10; ++thread) {
    text += "[thread.t" + std::to_string(thread) +
            "]\ntrigger = { period = \"10 ms\" }\npriority = " + std::to_string(10 + thread) +
            "\nrole = \"control\"\nunits = [";
    for (int i = 0; i < 100; ++i)
      text += (i == 0 ? "\"u" : ", \"u") + std::to_string(thread * 100 + i) + "\"";
    text += "]\n";
  }
  return text;
}

// All that a model says of its slots and units, as text.
std::string summary_of(const Model& model) {
  std::string text;
  for (const Slot& slot : model.slots)
    text += slot.name + " " + std::to_string(slot.reader_count) + " " + to_string(slot.position) + "\n";
  for (const Unit& unit : model.units)
    text += unit.name + " " + std::to_string(unit.thread.value_or(99)) + "\n";
  return text;
}

void a_large_application_reads_the_same_twice(void**) {
  std::filesystem::current_path(place::tests_folder);
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("flexrf_large_" + std::to_string(getpid()));
  std::filesystem::create_directories(folder / "units/twin");
  std::ofstream(folder / "units/twin/twin.toml") << "summary = \"Two in, two out.\"\n"
                                                    "[input.left]\ntype = \"Pose\"\nsummary = \"L.\"\n"
                                                    "[input.right]\ntype = \"Pose\"\nsummary = \"R.\"\n"
                                                    "[output.first]\ntype = \"Pose\"\nsummary = \"F.\"\n"
                                                    "[output.second]\ntype = \"Pose\"\nsummary = \"S.\"\n"
                                                    "[feedback.count]\ntype = \"u64\"\nsummary = \"C.\"\n";
  std::ofstream(folder / "cell.toml") << large_table();
  const auto before = std::chrono::steady_clock::now();
  const Result first = read_cell(folder);
  const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - before;
  std::printf("1000 units and %zu slots read and checked in %.0f ms\n", first.model.slots.size(),
              took.count());
  const Result second = read_cell(folder);
  std::filesystem::remove_all(folder);
  assert_string_equal(first.messages.c_str(), "");
  assert_int_equal(first.model.units.size(), 1000);
  assert_int_equal(first.model.slots.size(), 3000);  // with the feedback of each
  assert_true(summary_of(first.model) == summary_of(second.model));
}

}  // namespace
}  // namespace flexrf::config_gen::tests::model_test

int main() {
  using namespace flexrf::config_gen::tests::model_test;
  const CMUnitTest tests[] = {cmocka_unit_test(the_keyboard_example),
                              cmocka_unit_test(a_downloaded_robot),
                              cmocka_unit_test(values_override_defaults),
                              cmocka_unit_test(layouts_are_those_of_the_compiler),
                              cmocka_unit_test(readers_are_threads_and_holds),
                              cmocka_unit_test(populations_make_arrays),
                              cmocka_unit_test(a_value_that_rows_share_stands_once),
                              cmocka_unit_test(copies_are_queues_of_their_own),
                              cmocka_unit_test(children_come_before_buses),
                              cmocka_unit_test(memory_adds_up),
                              cmocka_unit_test(values_of_a_driver_lie_behind_its_interfaces),
                              cmocka_unit_test(ports_of_drivers_connect_as_those_of_units),
                              cmocka_unit_test(members_have_threads_of_their_own),
                              cmocka_unit_test(a_large_application_reads_the_same_twice)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
