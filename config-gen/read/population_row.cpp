// [widget.N] of the kind `population`.
#include <algorithm>

#include "config-gen/model/words.hpp"
#include "config-gen/read/panel_lists.hpp"
#include "config-gen/read/panel_options.hpp"

namespace flexrf::config_gen {
namespace {

class PopulationRow {
 public:
  PopulationRow(Assembly& assembly, Row& row, const PanelWidget& widget)
      : assembly_(assembly),
        row_(row),
        widget_(widget),
        options_(assembly, row,
                 {"population", "list", "generation", "active", "state", "fitness", "cost", "identity",
                  "parent", "weights", "weight_names", "columns"}) {}

  void check() {
    const Node* const slots = row_.node().find("slots");
    if (slots == nullptr || slots->find("members") == nullptr)
      row_.missing("slots.members",
                   "add slots = { members = \"NAME\" }: the slot whose type has the list of members");
    options_.need("list", "add list = \"FIELD\" to the options: the list of structures in the slot's type");
    options_.need("fitness", "add fitness = \"FIELD\" to the options: a number of each member");
    find_population();
    const Type* const type = slot_type();
    if (type == nullptr) return;
    options_.field(*type, "generation", field_kind::whole_number);
    const Field* const list = options_.field(*type, "list", field_kind::list_of_structures);
    if (list == nullptr) return;
    check_capacity(*list);
    check_members(assembly_.model.types[list->type.declared]);
  }

 private:
  // Null: there is none, or it has none, which is told.
  const Type* slot_type() {
    const auto role = std::find_if(widget_.slots.begin(), widget_.slots.end(),
                                   [](const auto& slot) { return slot.first == "members"; });
    if (role == widget_.slots.end()) return nullptr;
    const auto& slots = assembly_.model.slots;
    const auto slot = std::find_if(slots.begin(), slots.end(),
                                   [role](const Slot& one) { return one.name == role->second; });
    if (slot == slots.end() || slot->partial) return nullptr;
    const Type* const type = declared_type(assembly_.model, *slot);
    if (type == nullptr) {
      assembly_.diagnostics.error(
          row_.node().find("slots")->find("members")->position,
          "the slot " + quote(slot->name) + " carries parameters or feedback, and has no list of members",
          "name the slot of an output whose type has one");
    }
    return type;
  }

  void find_population() {
    const auto name = options_.text("population");
    if (!name || assembly_.broken_owners.contains(*name)) return;
    const auto found = assembly_.populations.find(*name);
    if (found != assembly_.populations.end()) {
      population_ = &assembly_.model.populations[found->second];
      return;
    }
    std::vector<std::string> known;
    for (const auto& [population, index] : assembly_.populations) known.push_back(population);
    options_.error("population", "unknown population " + quote(*name),
                   suggest(*name, known, "populations",
                           "this application has none: give a unit's row a capacity, or remove the option"));
  }

  void check_capacity(const Field& list) {
    if (population_ == nullptr || population_->capacity <= list.shape[0]) return;
    options_.error("population",
                   "the population " + quote(population_->name) + " has " +
                       std::to_string(population_->capacity) + " members, and " + quote(list.name) +
                       " room for " + std::to_string(list.shape[0]),
                   "name a list that has a place for each member");
  }

  void check_members(const Type& member) {
    options_.field(member, "active", field_kind::truth);
    options_.field(member, "fitness", field_kind::number);
    options_.field(member, "cost", field_kind::number);
    options_.field(member, "identity", field_kind::whole_number);
    options_.field(member, "parent", field_kind::whole_number);
    for (const std::string& name : options_.words("state"))
      options_.field(member, "state", name, field_kind::state);
    for (const std::string& name : options_.words("columns"))
      options_.field(member, "columns", name, field_kind::value);
    check_weights(options_.field(member, "weights", field_kind::numbers));
  }

  void check_weights(const Field* weights) {
    if (!options_.has("weight_names")) return;
    if (!options_.has("weights")) {
      options_.error("weight_names",
                     "'options.weight_names' of " + row_.name() + " names weights, and there are none",
                     "add weights = \"FIELD\" to the options, or remove it");
      return;
    }
    const std::vector<std::string> names = options_.words("weight_names");
    if (weights == nullptr || names.empty()) return;
    if (weights->shape.empty()) {
      options_.error("weight_names", quote(weights->name) + " is a structure, whose members have names",
                     "remove 'weight_names'");
      return;
    }
    if (names.size() != weights->shape[0]) {
      options_.error("weight_names",
                     "names of weights: " + std::to_string(names.size()) + ", numbers in " +
                         quote(weights->name) + ": " + std::to_string(weights->shape[0]),
                     "write a name for each number, in their order");
      return;
    }
    if (population_ != nullptr) check_parameters(names);
  }

  // Their ranges are those of the bars.
  void check_parameters(const std::vector<std::string>& names) {
    const UnitType& type = assembly_.model.unit_types[assembly_.model.units[population_->first].type];
    std::vector<std::string> known;
    for (const Parameter& parameter : type.runtime.parameters) {
      if (parameter.input == Parameter::Input::value && is_single_number(parameter.field))
        known.push_back(parameter.field.name);
    }
    for (const std::string& name : names) {
      if (std::find(known.begin(), known.end(), name) != known.end()) continue;
      options_.error("weight_names",
                     "the unit type " + quote(type.name) + " has no runtime parameter " + quote(name) +
                         " that is a number",
                     suggest(name, known, "numbers", "remove 'population', and the names are free"));
    }
  }

  Assembly& assembly_;
  Row& row_;
  const PanelWidget& widget_;
  WidgetOptions options_;
  const Population* population_ = nullptr;
};

}  // namespace

void check_population_row(Assembly& assembly, Row& row, const PanelWidget& widget) {
  PopulationRow(assembly, row, widget).check();
}

}  // namespace flexrf::config_gen
