// [renamed]: what configuration files written before call otherwise.
#include <algorithm>

#include "config-gen/model/words.hpp"
#include "config-gen/read/assembly.hpp"
#include "config-gen/read/row.hpp"

namespace flexrf::config_gen {
namespace {

constexpr std::string_view example =
    "write it as \"old_name\" = \"new_name\", or \"unit.old\" = \"unit.new\"";

// A unit, a device or a whole population, and what it saves.
struct Saved {
  std::string name;
  std::size_t members = 0;  // of a population
  std::vector<std::string> parameters;
};

void add_saved(const ParameterBlock& block, std::vector<std::string>& names) {
  for (const Parameter& parameter : block.parameters)
    if (parameter.kind == Parameter::Kind::configuration ||
        (parameter.persist && parameter.input == Parameter::Input::value))
      names.push_back(parameter.field.name);
}

std::vector<Saved> all_saved(const Model& model) {
  std::vector<Saved> all;
  const auto add_unit = [&](const std::string& name, std::size_t members, const Unit& unit) {
    Saved saved{name, members, {}};
    add_saved(model.unit_types[unit.type].configuration, saved.parameters);
    add_saved(model.unit_types[unit.type].runtime, saved.parameters);
    all.push_back(std::move(saved));
  };
  for (const Unit& unit : model.units) add_unit(unit.name, 0, unit);
  for (const Population& population : model.populations)
    add_unit(population.name, population.capacity, model.units[population.first]);
  for (const Device& device : model.devices) {
    Saved saved{device.name, 0, {}};
    add_saved(model.interfaces[device.interface].configuration, saved.parameters);
    add_saved(model.interfaces[device.interface].runtime, saved.parameters);
    for (const DriverChoice& choice : device.drivers) {
      add_saved(model.drivers[choice.driver].configuration, saved.parameters);
      add_saved(model.drivers[choice.driver].runtime, saved.parameters);
    }
    all.push_back(std::move(saved));
  }
  return all;
}

// "jog", or "axis[2].jog" and "step": what a name leads to, as far as it leads.
struct Place {
  const Saved* saved = nullptr;
  std::string owner;  // with a parameter: what stands before it
  std::string parameter;
  bool found = false;
};

const Saved* named(const std::vector<Saved>& all, const std::string& name) {
  const auto at =
      std::find_if(all.begin(), all.end(), [&](const Saved& saved) { return saved.name == name; });
  return at != all.end() ? &*at : nullptr;
}

Place place_of(const std::vector<Saved>& all, const std::string& name) {
  Place place;
  place.saved = named(all, name);
  place.found = place.saved != nullptr;
  const std::size_t dot = name.rfind('.');
  if (place.found || dot == std::string::npos) return place;
  place.owner = name.substr(0, dot);
  place.parameter = name.substr(dot + 1);
  place.saved = named(all, place.owner);
  if (place.saved == nullptr) return place;
  const auto& known = place.saved->parameters;
  place.found = std::find(known.begin(), known.end(), place.parameter) != known.end();
  return place;
}

std::vector<std::string> known_names(const std::vector<Saved>& all, const Place& place) {
  std::vector<std::string> names;
  if (place.saved != nullptr) {
    for (const std::string& parameter : place.saved->parameters)
      names.push_back(place.saved->name + "." + parameter);
  } else {
    for (const Saved& saved : all) names.push_back(saved.name);
  }
  return names;
}

// The file has one element for each member of a population.
void add_renames(const Node& row, const Place& from, const Place& to, std::vector<Rename>& renames) {
  const bool parameter = !to.parameter.empty();
  const std::string old_owner = parameter ? from.owner : row.key;
  const std::string tail = parameter ? "." + to.parameter : "";
  const std::string old_tail = parameter ? "." + from.parameter : "";
  if (to.saved->members == 0) renames.push_back({row.key, row.text, row.key_position});
  for (std::size_t member = 0; member < to.saved->members; ++member) {
    const std::string number = "[" + std::to_string(member) + "]";
    renames.push_back({old_owner + number + old_tail, to.saved->name + number + tail, row.key_position});
  }
}

bool leads_to(const Node& table, const std::string& old_owner, const std::string& owner) {
  const Node* row = table.find(old_owner);
  return old_owner == owner || (row != nullptr && row->text == owner);
}

}  // namespace

void read_renames(Assembly& assembly, const Node& table) {
  Diagnostics& diagnostics = assembly.diagnostics;
  if (table.kind != Node::Kind::table) {
    diagnostics.error(table.position, "'renamed' must be a table, not " + kind_text(table.kind),
                      std::string(example));
    return;
  }
  const std::vector<Saved> all = all_saved(assembly.model);
  for (const Node& row : table.children) {
    if (row.kind != Node::Kind::text) {
      diagnostics.error(row.position,
                        "the new name of " + quote(row.key) + " must be a text, not " + kind_text(row.kind),
                        std::string(example));
      continue;
    }
    const Place from = place_of(all, row.key);
    const Place to = place_of(all, row.text);
    if (assembly.is_broken_device(to.owner.empty() ? row.text : to.owner)) continue;
    if (from.found) {
      diagnostics.error(
          row.key_position, "the old name " + quote(row.key) + " is still in use",
          "the old name stands first, the new one second; remove the row if nothing was renamed");
    } else if (!to.found) {
      diagnostics.error(row.position, "nothing that is saved is named " + quote(row.text),
                        suggest(row.text, known_names(all, to), "names", "remove this row")
                            .doubted("it decides which saved values are loaded"));
    } else if (to.parameter.empty() ? from.saved != nullptr : from.parameter.empty()) {
      diagnostics.error(row.key_position,
                        quote(row.key) + " and " + quote(row.text) + " are not both parameters",
                        std::string(example));
    } else if (!to.parameter.empty() && !leads_to(table, from.owner, to.owner)) {
      diagnostics.error(row.key_position,
                        quote(row.key) + " is of " + quote(from.owner) + ", not of " + quote(to.owner),
                        "a parameter stays with its unit or device: add \"" + from.owner + "\" = \"" +
                            to.owner + "\" if that was renamed too");
    } else {
      add_renames(row, from, to, assembly.model.renames);
    }
  }
}

}  // namespace flexrf::config_gen
