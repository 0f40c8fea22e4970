// [widget.N] of the kind `timeline`.
#include <algorithm>

#include "config-gen/model/words.hpp"
#include "config-gen/read/panel_lists.hpp"
#include "config-gen/read/panel_options.hpp"

namespace flexrf::config_gen {
namespace {

class TimelineRow {
 public:
  TimelineRow(Assembly& assembly, Row& row)
      : assembly_(assembly),
        model_(assembly.model),
        row_(row),
        options_(assembly, row, {"rows", "frame", "frames", "result", "list", "count", "fields"}) {}

  void check() {
    options_.need("rows",
                  "add rows = \"NAME, NAME\" to the options: populations and units whose work is shown");
    options_.need("frame", "add frame = \"UNIT\" to the options: each of its steps begins a frame");
    options_.check_whole_number("frames", 2, 30);
    check_frame();
    for (const std::string& name : options_.words("rows")) add_row(name);
    if (options_.has("result")) return check_result();
    for (const char* const name : {"list", "count", "fields"}) {
      if (!options_.has(name)) continue;
      options_.error(
          name,
          "'options." + std::string(name) + "' of " + row_.name() + " is of a result, and there is none",
          "add result = \"OUTPUT\" to the options, or remove it");
    }
  }

 private:
  bool is_broken(const std::string& name) const { return assembly_.broken_owners.contains(name); }

  std::vector<std::string> names_of_units(bool populations) const {
    std::vector<std::string> names;
    for (const Unit& unit : model_.units)
      if (!unit.population || !populations) names.push_back(unit.name);
    if (populations)
      for (const auto& [name, index] : assembly_.populations) names.push_back(name);
    return names;
  }

  void check_frame() {
    const auto name = options_.text("frame");
    if (!name || is_broken(*name) || assembly_.units.contains(*name)) return;
    if (assembly_.populations.contains(*name)) {
      options_.error("frame", quote(*name) + " is a population: frames begin with the steps of one unit",
                     "name a unit, or a member, as \"" + *name + "[0]\"");
      return;
    }
    options_.error("frame", "unknown unit " + quote(*name),
                   suggest(*name, names_of_units(false), "units", "there is none"));
  }

  void add_row(const std::string& name) {
    if (const auto population = assembly_.populations.find(name); population != assembly_.populations.end()) {
      const Population& members = model_.populations[population->second];
      for (std::size_t i = 0; i < members.capacity; ++i) units_.push_back(members.first + i);
    } else if (const auto unit = assembly_.units.find(name); unit != assembly_.units.end()) {
      units_.push_back(unit->second);
    } else if (is_broken(name)) {
      incomplete_ = true;
    } else {
      incomplete_ = true;
      options_.error("rows", "unknown population or unit " + quote(name),
                     suggest(name, names_of_units(true), "populations and units", "there is none"));
    }
  }

  void check_result() {
    options_.need("fields", "add fields = \"FIELD, FIELD\" to the options: what is shown of the result");
    if (options_.has("list"))
      options_.need("count", "add count = \"FIELD\" to the options: how many the list had so far");
    const auto port = options_.text("result");
    if (!port) return;
    bool found = false;
    bool observed = true;  // told once
    std::vector<std::string> known;
    std::set<Index> types;
    for (const Index index : units_) {
      const Unit& unit = model_.units[index];
      const std::vector<OutputPort>& outputs = model_.unit_types[unit.type].outputs;
      for (std::size_t i = 0; i < outputs.size(); ++i) {
        if (outputs[i].queue) continue;
        known.push_back(outputs[i].name);
        if (outputs[i].name != *port) continue;
        found = true;
        types.insert(outputs[i].type);
        if (i < unit.outputs.size()) observed = observed && check_observed(unit.outputs[i]);
      }
    }
    if (!found) {
      if (!incomplete_ && options_.has("rows"))
        options_.error("result", "no unit of the rows has an output " + quote(*port) + " into a slot",
                       suggest(*port, known, "outputs", "they have none: remove it"));
      return;
    }
    for (const Index type : types) check_fields(model_.types[type]);
  }

  bool check_observed(const OutputConnection& output) {
    if (!output.slot || model_.slots[*output.slot].observe) return true;
    const Slot& slot = model_.slots[*output.slot];
    options_.error("result", "the slot " + quote(slot.name) + " is not observed: no panel can show it",
                   "remove observe = false from its row at " + to_string(slot.position));
    return false;
  }

  void check_fields(const Type& type) {
    const Type* shown = &type;
    if (options_.has("list")) {
      options_.field(type, "count", field_kind::whole_number);
      const Field* const list = options_.field(type, "list", field_kind::list_of_structures);
      if (list == nullptr) return;
      shown = &model_.types[list->type.declared];
    } else if (options_.has("count")) {
      options_.error("count", "'options.count' of " + row_.name() + " is of a list, and there is none",
                     "add list = \"FIELD\" to the options, or remove it");
    }
    for (const std::string& path : options_.words("fields")) check_path(*shown, path);
  }

  // "region.frame": members of structures.
  void check_path(const Type& type, std::string_view path) {
    const std::size_t dot = path.find('.');
    if (dot == std::string_view::npos) {
      options_.field(type, "fields", path, field_kind::value);
      return;
    }
    const Field* const structure = options_.field(type, "fields", path.substr(0, dot), field_kind::structure);
    if (structure != nullptr) check_path(model_.types[structure->type.declared], path.substr(dot + 1));
  }

  Assembly& assembly_;
  Model& model_;
  Row& row_;
  WidgetOptions options_;
  std::vector<Index> units_;  // of all rows
  bool incomplete_ = false;   // a row is not known
};

}  // namespace

void check_timeline_row(Assembly& assembly, Row& row) {
  TimelineRow(assembly, row).check();
}

}  // namespace flexrf::config_gen
