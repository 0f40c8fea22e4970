// Groups: instances, arguments, nesting, ports.
#include "config-gen/tests/find.hpp"
#include "config-gen/tests/tables.hpp"
#include "places.hpp"
#include "tests/cmocka.hpp"

namespace flexrf::config_gen::tests::group_test {
namespace {

const Result& axes() {
  static const Result result = [] {
    std::filesystem::current_path(place::tests_folder);
    return read_cell("cells/axes");
  }();
  return result;
}

void it_reads_without_a_word(void**) {
  assert_string_equal(axes().messages.c_str(), "");
  assert_false(axes().failed);
}

void names_have_prefixes_in_source_order(void**) {
  const Model& model = axes().model;
  const char* units[] = {"source",
                         "machine[0].axis[0].drive",
                         "machine[0].axis[1].drive",
                         "machine[0].axis[2].drive",
                         "machine[0].tap",
                         "machine[0].mean",
                         "machine[1].axis[0].drive",
                         "machine[1].axis[1].drive",
                         "machine[1].axis[2].drive",
                         "machine[1].tap",
                         "machine[1].mean",
                         "fusion"};
  assert_int_equal(model.units.size(), std::size(units));
  for (std::size_t i = 0; i < std::size(units); ++i)
    assert_string_equal(model.units[i].name.c_str(), units[i]);
  assert_int_equal(model.groups.size(), 8);
  assert_string_equal(model.groups[1].name.c_str(), "machine[0].axis[0]");
  assert_string_equal(model.groups[1].table.c_str(), "axis");
}

void arguments_reach_the_innermost(void**) {
  const Model& model = axes().model;
  const Unit& drive = named(model.units, "machine[1].axis[2].drive");
  assert_int_equal(drive.budget.value_or(0), 20'000);
  const Device& servo = named(model.devices, "machine[1].axis[2].servo");
  assert_true(servo.bus == index_of(model.devices, "can0"));
  assert_int_equal(named(model.devices, "can0").children.size(), 6);
  assert_string_equal(named(model.slots, "machine[1].mean").summary.c_str(), "Mean position of machine 1.");
}

// An input port leads one slot to all instances; an output port of a counted group makes an array.
void ports_connect_across(void**) {
  const Model& model = axes().model;
  const std::size_t goal = index_of(model.slots, "goal");
  for (const char* name : {"machine[0].axis[0].drive", "machine[1].axis[2].drive"}) {
    const Unit& drive = named(model.units, name);
    assert_int_equal(drive.inputs[0].slots.size(), 1);
    assert_int_equal(drive.inputs[0].slots[0], goal);
  }
  assert_int_equal(model.slots[goal].inputs.size(), 6);
  const Unit& mean = named(model.units, "machine[1].mean");
  assert_int_equal(mean.inputs[0].slots.size(), 3);
  assert_string_equal(model.slots[mean.inputs[0].slots[2]].name.c_str(), "machine[1].positions[2]");
}

// "tapped" is connected inside and exposed as "first": one slot, under its outer name.
void an_exposed_slot_is_one_slot(void**) {
  const Model& model = axes().model;
  assert_false(has(model.slots, "machine[0].tapped"));
  const std::size_t first = index_of(model.slots, "firsts[1]");
  const Unit& tap = named(model.units, "machine[1].tap");
  assert_true(tap.outputs[0].slot == first);
  const std::size_t local = index_of(model.threads, "machine[1].local");
  const Slot& position = named(model.slots, "machine[1].positions[2]");
  assert_int_equal(position.doorbells.size(), 1);
  assert_int_equal(position.doorbells[0], local);
  const Unit& fusion = named(model.units, "fusion");
  assert_int_equal(fusion.inputs[0].slots.size(), 2);
}

void a_thread_around_lists_units_inside(void**) {
  const Model& model = axes().model;
  const Thread& main = named(model.threads, "main");
  assert_int_equal(main.units.size(), 8);
  assert_string_equal(model.units[main.units[7]].name.c_str(), "machine[1].axis[2].drive");
}

}  // namespace
}  // namespace flexrf::config_gen::tests::group_test

int main() {
  using namespace flexrf::config_gen::tests::group_test;
  const CMUnitTest tests[] = {
      cmocka_unit_test(it_reads_without_a_word),       cmocka_unit_test(names_have_prefixes_in_source_order),
      cmocka_unit_test(arguments_reach_the_innermost), cmocka_unit_test(ports_connect_across),
      cmocka_unit_test(an_exposed_slot_is_one_slot),   cmocka_unit_test(a_thread_around_lists_units_inside)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
