// [panel] and [widget.N] of applications.
#include <algorithm>
#include <functional>
#include <map>

#include "config-gen/model/words.hpp"
#include "config-gen/read/assembly.hpp"
#include "config-gen/read/panel_fields.hpp"
#include "config-gen/read/panel_files.hpp"
#include "config-gen/read/panel_layers.hpp"
#include "config-gen/read/panel_lists.hpp"
#include "config-gen/read/panel_options.hpp"
#include "config-gen/read/widget_kinds.hpp"

namespace flexrf::config_gen {
namespace {

struct ShownParameter {
  const Parameter* parameter = nullptr;
  const std::vector<ParameterOverride>* overrides = nullptr;  // of its unit or device
};

/// What a widget's row can name, as the panel calls it.
struct Names {
  std::vector<std::string> places;      // "overview", units and devices
  std::vector<std::string> slots;       // observed or not
  std::vector<std::string> parameters;  // "jog.step", "arm.configuration.noise", "jog.feedback.presses"
  std::map<std::string, ShownParameter, std::less<>> shown;  // the parameters; of drivers the first of a name
  std::vector<std::string> devices;
};

void add_parameters(const std::string& owner, const ParameterBlock& block,
                    const std::vector<ParameterOverride>& overrides, Names& names) {
  constexpr const char* middle[] = {".configuration.", ".", ".feedback."};
  for (const Parameter& parameter : block.parameters) {
    names.parameters.push_back(owner + middle[static_cast<std::size_t>(parameter.kind)] +
                               parameter.field.name);
    names.shown.try_emplace(names.parameters.back(), ShownParameter{&parameter, &overrides});
  }
}

Names names_of(const Model& model) {
  Names names;
  names.places.push_back("overview");
  for (const Slot& slot : model.slots) names.slots.push_back(slot.name);
  for (const Unit& unit : model.units) {
    names.places.push_back(unit.name);
    const UnitType& type = model.unit_types[unit.type];
    for (const ParameterBlock* block : {&type.runtime, &type.configuration, &type.feedback})
      add_parameters(unit.name, *block, unit.overrides, names);
  }
  for (const Device& device : model.devices) {
    names.places.push_back(device.name);
    names.devices.push_back(device.name);
    const Interface& type = model.interfaces[device.interface];
    for (const ParameterBlock* block : {&type.runtime, &type.configuration, &type.feedback})
      add_parameters(device.name, *block, device.overrides, names);
    for (const DriverChoice& choice : device.drivers) {
      const Driver& driver = model.drivers[choice.driver];
      for (const ParameterBlock* block : {&driver.runtime, &driver.configuration, &driver.feedback})
        add_parameters(device.name, *block, device.overrides, names);
    }
  }
  return names;
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

class Reader {
 public:
  explicit Reader(Assembly& assembly) : assembly_(assembly), names_(names_of(assembly.model)) {}

  void read_settings(const Node& node);
  void read_widget(const Node& node);
  void check_overrides();

 private:
  void check_place(const std::string& place, const Position& position);
  void check_kind(Row& row, PanelWidget& widget);
  void read_slots(Row& row, PanelWidget& widget);
  void read_parameters(Row& row, PanelWidget& widget);
  void check_joints(const Node& joints, const PanelWidget& widget);
  void read_device(Row& row, PanelWidget& widget);
  void read_options(Row& row, PanelWidget& widget);
  void check_roles(Row& row, const PanelWidget& widget);
  void check_role_names(Row& row, const char* key, const PanelWidget& widget);
  void check_item(Row& row, const PanelWidget& widget);
  void check_holds(Row& row, const PanelWidget& widget);
  /// Takes what a kind that is not built-in is made by into the application; false where there is no such
  /// file.
  bool add_own_kind(const std::string& kind);
  void check_own_kind(const std::string& kind, const Position& position);
  /// The texts of a table { role = "name" }.
  std::vector<const Node*> roles(Row& row, const char* key);
  bool is_broken(const std::string& owner) const { return assembly_.is_broken_device(owner); }

  Assembly& assembly_;
  Names names_;
};

void Reader::read_settings(const Node& node) {
  Row row(node, "[panel]", assembly_.diagnostics);
  Panel& panel = assembly_.model.panel;
  if (const auto connections = row.integer("connections", 4, 256))
    panel.connections = static_cast<std::size_t>(*connections);
  panel.session_timeout =
      row.positive_duration("session_timeout", session_bounds).value_or(panel.session_timeout);
  panel.session_length =
      row.positive_duration("session_length", session_bounds).value_or(panel.session_length);
  panel.loopback_is_local = row.boolean("loopback_is_local").value_or(true);
  if (const Node* local = row.list_of_texts("local"); local != nullptr) {
    for (const Node& address : local->children) {
      if (is_address(address.text)) {
        panel.local.push_back(address.text);
      } else {
        assembly_.diagnostics.error(address.position, quote(address.text) + " is not an address",
                                    "write it in numbers, as \"192.168.1.20\" or \"fd00::20\"");
      }
    }
  }
  row.finish();
}

void Reader::check_place(const std::string& place, const Position& position) {
  if (contains(names_.places, place) || is_broken(place)) return;
  assembly_.diagnostics.error(position, "there is no place " + quote(place) + " on the panel",
                              suggest(place, names_.places, "places", ""));
}

void Reader::check_overrides() {
  const auto check = [this](const std::vector<ParameterOverride>& changes) {
    for (const ParameterOverride& change : changes) {
      if (change.place) check_place(*change.place, change.place_position);
      if (change.widget && !is_built_in_widget(*change.widget))
        check_own_kind(*change.widget, change.widget_position);
    }
  };
  for (const auto& [name, shown] : names_.shown)
    if (const std::string& kind = shown.parameter->widget; !kind.empty() && !is_built_in_widget(kind))
      check_own_kind(kind, shown.parameter->field.position);
  std::optional<Index> population;
  for (const Unit& unit : assembly_.model.units) {
    // Members share their row.
    if (!unit.population || unit.population != population) check(unit.overrides);
    population = unit.population;
  }
  for (const Device& device : assembly_.model.devices) check(device.overrides);
}

void Reader::check_kind(Row& row, PanelWidget& widget) {
  const auto kind = row.required_text("kind", "add kind = \"gauge\", or the name of a file in widgets/");
  if (!kind) return;
  widget.kind = *kind;
  if (is_built_in_widget(*kind)) return;
  widget.custom = true;
  check_own_kind(*kind, row.position("kind"));
}

bool Reader::add_own_kind(const std::string& kind) {
  const std::filesystem::path file =
      assembly_.model.application->file.parent_path() / "widgets" / (kind + ".js");
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored)) return false;
  add_panel_file(assembly_.model, {"widgets/" + kind + ".js", "text/javascript", file});
  return true;
}

void Reader::check_own_kind(const std::string& kind, const Position& position) {
  if (!is_snake_case(kind)) {
    assembly_.diagnostics.error(position, quote(kind) + " is not a name for a kind of widget",
                                "names are lower_snake_case: small letters, digits and single underscores");
    return;
  }
  if (add_own_kind(kind)) return;
  Hint hint = suggest(kind, built_in_widgets(), "kinds", "");
  if (!hint.replacement) hint = "write the file, or use a built-in kind: " + listed(built_in_widgets());
  assembly_.diagnostics.error(position,
                              quote(kind) + " is neither a built-in kind of widget nor a file " +
                                  quote("widgets/" + kind + ".js") + " beside the application's table",
                              std::move(hint));
}

std::vector<const Node*> Reader::roles(Row& row, const char* key) {
  std::vector<const Node*> texts;
  const Node* table = row.table(key);
  if (table == nullptr) return texts;
  for (const Node& child : table->children) {
    if (child.kind == Node::Kind::text) {
      texts.push_back(&child);
    } else {
      assembly_.diagnostics.error(child.position,
                                  quote(std::string(key) + "." + child.key) + " of " + row.name() +
                                      " must be a text, not " + kind_text(child.kind),
                                  "write the name in double quotes");
    }
  }
  return texts;
}

void Reader::read_slots(Row& row, PanelWidget& widget) {
  for (const Node* child : roles(row, "slots")) {
    const auto& slots = assembly_.model.slots;
    const auto found =
        std::find_if(slots.begin(), slots.end(), [&](const Slot& slot) { return slot.name == child->text; });
    if (found == slots.end()) {
      if (!assembly_.broken_places.contains(array_base(child->text)))
        assembly_.diagnostics.error(child->position, "unknown slot " + quote(child->text),
                                    suggest(child->text, names_.slots, "slots", "there is none"));
    } else if (check_observed(assembly_, *found, child->position)) {
      widget.slots.emplace_back(child->key, child->text);
    }
  }
}

void Reader::read_parameters(Row& row, PanelWidget& widget) {
  for (const Node* child : roles(row, "parameters")) {
    const std::size_t dot = child->text.rfind('.');
    const std::string owner = child->text.substr(0, dot);
    const std::string name = dot == std::string::npos ? "" : child->text.substr(dot + 1);
    const std::string candidates[] = {child->text, owner + ".configuration." + name,
                                      owner + ".feedback." + name};
    const auto found =
        std::find_if(std::begin(candidates), std::end(candidates),
                     [&](const std::string& candidate) { return contains(names_.parameters, candidate); });
    if (found != std::end(candidates)) {
      widget.parameters.emplace_back(child->key, *found);
    } else if (!is_broken(owner)) {
      // Of a known owner all parameters, else the owners.
      std::vector<std::string> known;
      for (const std::string& parameter : names_.parameters)
        if (parameter.starts_with(owner + ".")) known.push_back(parameter);
      assembly_.diagnostics.error(
          child->position, "unknown parameter " + quote(child->text),
          known.empty() ? suggest(child->text, names_.parameters, "parameters", "there is none")
                        : suggest(child->text, known, "parameters", "this application has none: remove it"));
    }
  }
}

void Reader::read_device(Row& row, PanelWidget& widget) {
  const auto name = row.text("device");
  if (name) {
    const auto found = assembly_.devices.find(*name);
    if (found != assembly_.devices.end()) {
      widget.device = found->second;
    } else if (!is_broken(*name)) {
      assembly_.diagnostics.error(
          row.position("device"), "unknown device " + quote(*name),
          suggest(*name, names_.devices, "devices", "declare it as [device." + *name + "]"));
    }
  }
  if (widget.kind != "robot") return;
  const Node* const slots = row.node().find("slots");
  const Node* const joints = slots == nullptr ? nullptr : slots->find("joints");
  if (joints == nullptr)
    row.missing("slots.joints", "add slots = { joints = \"NAME\" }: the slot with the joints' positions");
  else
    check_joints(*joints, widget);
  if (!name) {
    row.missing("device", "add device = \"arm\": the robot to be shown");
  } else if (widget.device && !robot_of(assembly_.model, *widget.device)) {
    assembly_.diagnostics.error(row.position("device"), quote(*name) + " has no URDF that could be shown",
                                "name a device whose row has urdf = \"FILE\"");
  }
}

// The panel takes the joints' positions from the field `position` of this slot, whatever else it carries.
void Reader::check_joints(const Node& joints, const PanelWidget& widget) {
  const auto& slots = assembly_.model.slots;
  const auto found =
      std::find_if(slots.begin(), slots.end(), [&](const Slot& slot) { return slot.name == joints.text; });
  const DeviceResource* const robot = widget.device ? robot_of(assembly_.model, *widget.device) : nullptr;
  if (found == slots.end() || found->partial || robot == nullptr || !robot->chain) return;
  const std::size_t count = robot->chain->joints.size();
  const auto fits = [&](const Field& field) {
    return field.name == "position" && field.type.kind == FieldType::Kind::scalar &&
           field.type.scalar != Scalar::boolean && field.type.scalar != Scalar::text &&
           field.shape.size() == 1 && field.shape[0] >= count;
  };
  const Type* const type = declared_type(assembly_.model, *found);
  if (type != nullptr && std::any_of(type->fields.begin(), type->fields.end(), fits)) return;
  const std::string& device = assembly_.model.devices[*widget.device].name;
  const std::string numbers =
      count == 1 ? "a number for the joint" : "a number for each of the " + std::to_string(count) + " joints";
  assembly_.diagnostics.error(joints.position,
                              "the widget 'robot' cannot show " + quote(joints.text) +
                                  ": it needs a slot with a field 'position' that has " + numbers + " of " +
                                  quote(device),
                              "name another slot, such as the output 'joints' of a unit robot_control");
}

void Reader::read_options(Row& row, PanelWidget& widget) {
  const Node* table = row.table("options");
  if (table == nullptr) return;
  for (const Node& child : table->children) {
    switch (child.kind) {
      case Node::Kind::boolean:
        widget.options.emplace_back(child.key, child.boolean);
        break;
      case Node::Kind::integer:
        widget.options.emplace_back(child.key, child.integer);
        break;
      case Node::Kind::real:
        widget.options.emplace_back(child.key, child.real);
        break;
      case Node::Kind::text:
        widget.options.emplace_back(child.key, child.text);
        break;
      default:
        assembly_.diagnostics.error(
            child.position,
            quote("options." + child.key) + " of " + row.name() + " is " + kind_text(child.kind),
            "an option is one value: a number, a text, true or false");
    }
  }
}

void Reader::check_role_names(Row& row, const char* key, const PanelWidget& widget) {
  const WidgetRoles roles = roles_of_widget(widget.kind);
  const bool is_slots = key == std::string_view("slots");
  const std::vector<std::string>& known = is_slots ? roles.slots : roles.parameters;
  const Node* const table = row.node().find(key);
  if (table == nullptr || table->kind != Node::Kind::table || (!is_slots && roles.any_parameters)) return;
  for (const Node& child : table->children)
    if (!contains(known, child.key))
      assembly_.diagnostics.error(
          child.key_position,
          quote(child.key) + " in " + quote(key) + " of " + row.name() + " is no role of the widget " +
              quote(widget.kind),
          suggest(child.key, known, "roles", "remove it: this widget shows no " + std::string(key)));
}

void Reader::check_holds(Row& row, const PanelWidget& widget) {
  for (const auto& [role, name] : widget.parameters) {
    const auto found = names_.shown.find(name);
    if (found == names_.shown.end() || found->second.parameter->input == Parameter::Input::hold) continue;
    assembly_.diagnostics.error(
        row.node().find("parameters")->find(role)->position,
        quote(name) + " is no hold, and a jog_pad is made of holds",
        "name a parameter of the type \"hold\", or place this one by a row of its own");
  }
}

// The one item that a widget shows or changes.
void Reader::check_item(Row& row, const PanelWidget& widget) {
  const auto named = [&row](const char* key) -> const Node* {
    const Node* const table = row.node().find(key);
    return table == nullptr ? nullptr : table->find("value");
  };
  const Node* const slot = named("slots");
  const Node* const parameter = named("parameters");
  const auto misspelt = [&row](const char* key) {
    const Node* const table = row.node().find(key);
    return table != nullptr && !table->children.empty();
  };
  if (slot != nullptr && parameter != nullptr) {
    assembly_.diagnostics.error(slot->key_position,
                                row.name() + " has a value in 'slots' and one in 'parameters'",
                                "the widget shows one of them: remove the other");
    return;
  }
  if (slot == nullptr && parameter == nullptr) {
    if (!misspelt("slots") && !misspelt("parameters"))
      row.missing(
          "parameters",
          "add parameters = { value = \"UNIT.PARAMETER\" }, or slots = { value = \"SLOT\" }: what it shows");
    return;
  }
  std::string needs;
  if (parameter != nullptr && !widget.parameters.empty()) {
    const auto found = names_.shown.find(widget.parameters.front().second);
    if (found == names_.shown.end()) return;
    const Parameter& shown = *found->second.parameter;
    const std::vector<ParameterOverride>& overrides = *found->second.overrides;
    const bool has_range =
        std::any_of(overrides.begin(), overrides.end(), [&](const ParameterOverride& change) {
          return change.parameter == shown.field.name && change.kind == shown.kind && change.low.has_value();
        });
    needs = widget_misfit(assembly_.model, widget.kind, shown, has_range);
  } else if (slot != nullptr && !widget.slots.empty()) {
    const auto& slots = assembly_.model.slots;
    const auto found = std::find_if(slots.begin(), slots.end(),
                                    [&](const Slot& one) { return one.name == widget.slots.front().second; });
    if (found->partial) return;
    needs = widget_misfit(declared_type(assembly_.model, *found), widget.kind);
  }
  if (needs.empty()) return;
  const Node& value = slot != nullptr ? *slot : *parameter;
  assembly_.diagnostics.error(
      value.position,
      "the widget " + quote(widget.kind) + " cannot show " + quote(value.text) + ": it needs " + needs,
      "name another item, or another kind of widget");
}

void Reader::check_roles(Row& row, const PanelWidget& widget) {
  if (widget.custom || widget.kind.empty()) return;
  check_role_names(row, "slots", widget);
  check_role_names(row, "parameters", widget);
  if (widget.kind == "jog_pad") check_holds(row, widget);
  if (roles_of_widget(widget.kind).is_single) check_item(row, widget);
}

void Reader::read_widget(const Node& node) {
  Row row(node, "[widget." + node.key + "]", assembly_.diagnostics);
  PanelWidget widget;
  widget.name = node.key;
  widget.position = node.key_position;
  widget.label = row.text("label").value_or("");
  widget.summary = row.sentence("summary").value_or("");
  if (const auto place = row.text("place")) {
    widget.place = *place;
    check_place(*place, row.position("place"));
  }
  check_kind(row, widget);
  read_slots(row, widget);
  read_parameters(row, widget);
  read_device(row, widget);
  read_options(row, widget);
  check_roles(row, widget);
  read_layers(assembly_, row, widget);
  if (widget.kind == "population") check_population_row(assembly_, row, widget);
  if (widget.kind == "timeline") check_timeline_row(assembly_, row);
  row.finish();
  assembly_.model.panel.widgets.push_back(std::move(widget));
}

}  // namespace

void read_panel(Assembly& assembly) {
  const Node& root = assembly.flat.scopes.front().tree;
  for (Index device = 0; device < assembly.model.devices.size(); ++device) add_robot_files(assembly, device);
  Reader reader(assembly);
  if (const Node* panel = root.find("panel"); panel != nullptr) {
    if (panel->kind == Node::Kind::table) {
      reader.read_settings(*panel);
    } else {
      assembly.diagnostics.error(panel->position, "'panel' must be a table, not " + kind_text(panel->kind),
                                 "write it as [panel], and its keys below");
    }
  }
  for (const Node* widget : named_rows(assembly.library, root, "widget", "a widget"))
    reader.read_widget(*widget);
  reader.check_overrides();
}

}  // namespace flexrf::config_gen
