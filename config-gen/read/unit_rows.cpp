// [unit.N] rows of applications and groups.
#include <numeric>

#include "config-gen/model/limits.hpp"
#include "config-gen/model/words.hpp"
#include "config-gen/read/assembly.hpp"

namespace flexrf::config_gen {
namespace {

void add_population(Assembly& assembly, Row& row, Unit unit, std::size_t capacity, std::size_t active) {
  Model& model = assembly.model;
  Population population{unit.name, unit.position, model.units.size(), capacity, active};
  assembly.unit_rows.back().count = capacity;
  assembly.unit_rows.back().population = true;
  assembly.populations.emplace(unit.name, model.populations.size());
  for (std::size_t member = 0; member < capacity; ++member) {
    Unit one = unit;
    one.name = unit.name + "[" + std::to_string(member) + "]";
    one.population = model.populations.size();
    one.member = member;
    one.active = member < active;
    assembly.units.emplace(one.name, model.units.size());
    model.units.push_back(std::move(one));
  }
  model.populations.push_back(std::move(population));
  const UnitType& type = model.unit_types[unit.type];
  if (!type.devices.empty())
    assembly.diagnostics.error(row.position("capacity"),
                               row.name() + " cannot be a population: " + quote(type.name) + " owns a device",
                               "a device has one owner: write one row per unit, or a group with a count");
}

std::size_t values_in(const Literal& value) {
  if (value.elements.empty()) return 1;
  return std::accumulate(value.elements.begin(), value.elements.end(), std::size_t{0},
                         [](std::size_t sum, const Literal& part) { return sum + values_in(part); });
}

// Before each member gets its own copy of what the row says.
void check_room(Assembly& assembly, const Unit& unit, std::size_t count) {
  if (assembly.model.units.size() + count > max_units)
    assembly.diagnostics.give_up(
        unit.position, "with this row the application has more than " + std::to_string(max_units) + " units",
        "members of populations count: lower a 'capacity' or a 'count'");
  std::size_t values = 0;
  for (const auto* block : {&unit.configuration, &unit.runtime})
    for (const Literal& value : *block) values += values_in(value);
  assembly.values += values * count;
  if (assembly.values > max_application_values)
    assembly.diagnostics.give_up(unit.position,
                                 "with this row the application's parameters have more than " +
                                     std::to_string(max_application_values) + " values",
                                 "lower a 'capacity' or a 'count', or make an array of a parameter smaller");
}

}  // namespace

void read_unit_row(Assembly& assembly, const FlatRow& flat) {
  Model& model = assembly.model;
  Row row(*flat.node, "[unit." + flat.node->key + "]", assembly.diagnostics);
  const auto name = row.required_text("type", "add type = \"jog\", the name of a unit's folder");
  const auto type_index = name ? assembly.library.unit(*name, row.position("type")) : std::nullopt;
  if (!type_index) {
    mark_broken(assembly, flat);
    return;
  }
  const UnitType& type = model.unit_types[*type_index];
  Unit unit;
  unit.name = flat.scope->prefix + flat.node->key;
  unit.position = flat.node->key_position;
  unit.type = *type_index;
  unit.inputs.resize(type.inputs.size());
  unit.outputs.resize(type.outputs.size());
  unit.devices.resize(type.devices.size());
  row.table("in");
  row.table("out");
  row.table("device");
  unit.budget = row.positive_duration("budget", release_bounds);
  unit.budget_position = row.position("budget");
  unit.initialise_timeout =
      row.positive_duration("initialise_timeout", supervision_bounds).value_or(unit.initialise_timeout);
  unit.stop_timeout = row.positive_duration("stop_timeout", supervision_bounds);
  if (const auto restart = row.word("restart", {"never", "once", "always"}))
    unit.restart = static_cast<Unit::Restart>(*restart);
  unit.configuration =
      read_values(assembly, row.table("configuration"), type.configuration, "configuration", row.name());
  check_needs_of_configuration(assembly, {type.configuration, unit.configuration}, std::nullopt, row);
  unit.runtime = read_values(assembly, row.table("runtime"), type.runtime, "runtime", row.name());
  unit.overrides =
      read_overrides(assembly, row.table("parameter"), {&type.runtime, &type.configuration, &type.feedback},
                     "the unit type " + quote(type.name), row.name());
  check_narrowed(assembly, unit.overrides, type.configuration, unit.configuration);
  check_narrowed(assembly, unit.overrides, type.runtime, unit.runtime);
  const auto capacity = row.integer("capacity", 1, 4096);
  const auto active = row.integer("active", 0, 4096);
  row.finish();

  const std::size_t count = row.has("capacity") ? static_cast<std::size_t>(capacity.value_or(1)) : 1;
  check_room(assembly, unit, count);
  assembly.unit_rows.push_back({&flat, model.units.size(), 1, false});
  if (active && !row.has("capacity"))
    assembly.diagnostics.error(
        row.position("active"), "'active' of " + row.name() + " needs a 'capacity'",
        "only populations have members that can rest: add capacity = 16, or remove 'active'");
  if (active && capacity && *active > *capacity)
    assembly.diagnostics.error(row.position("active"),
                               row.name() + " starts with " + std::to_string(*active) +
                                   " active members of " + std::to_string(*capacity),
                               "'active' is at most 'capacity'");
  if (row.has("capacity")) {
    add_population(assembly, row, std::move(unit), count,
                   static_cast<std::size_t>(active.value_or(capacity.value_or(1))));
    return;
  }
  assembly.units.emplace(unit.name, model.units.size());
  model.units.push_back(std::move(unit));
}

}  // namespace flexrf::config_gen
