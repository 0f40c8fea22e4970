// Values that an application's rows give to parameters.
#include <algorithm>

#include "config-gen/model/words.hpp"
#include "config-gen/read/assembly.hpp"
#include "config-gen/read/literal.hpp"

namespace flexrf::config_gen {
namespace {

// Neither false nor 0 nor empty; of an array one element is enough.
bool is_set(const Literal& literal) {
  if (const auto* const text = std::get_if<std::string>(&literal.value)) return !text->empty();
  return number_of(literal) != 0 || std::any_of(literal.elements.begin(), literal.elements.end(), is_set);
}

const Literal* find_value(const ConfigurationPart& part, const std::string& name) {
  for (std::size_t i = 0; i < part.block.parameters.size() && i < part.values.size(); ++i)
    if (part.block.parameters[i].field.name == name) return &part.values[i];
  return nullptr;
}

}  // namespace

std::vector<Literal> read_values(Assembly& assembly, const Node* table, const ParameterBlock& block,
                                 const std::string& section, const std::string& row_name) {
  std::vector<Literal> values;
  std::vector<std::string> known;
  for (const Parameter& parameter : block.parameters) {
    known.push_back(parameter.field.name);
    values.push_back(parameter.initial);
  }
  if (table == nullptr) return values;
  for (const Node& child : table->children) {
    std::size_t i = 0;
    while (i < known.size() && known[i] != child.key) ++i;
    if (i == known.size()) {
      assembly.diagnostics.error(child.key_position,
                                 "unknown " + section + " parameter " + quote(child.key) + " in " + row_name,
                                 suggest(child.key, known, "parameters", "it has none: remove this line"));
      continue;
    }
    const Parameter& parameter = block.parameters[i];
    if (parameter.input != Parameter::Input::value) {
      assembly.diagnostics.error(child.position,
                                 quote(child.key) + " in " + row_name + " is a " +
                                     (parameter.input == Parameter::Input::button ? "button" : "hold") +
                                     " and has no value",
                                 "remove this line: it starts released");
      continue;
    }
    if (auto value =
            read_parameter_value(assembly.model, parameter, child,
                                 quote(section + "." + child.key) + " of " + row_name, assembly.diagnostics))
      values[i] = std::move(*value);
  }
  return values;
}

void check_needs_of_configuration(Assembly& assembly, const ConfigurationPart& own,
                                  const std::optional<ConfigurationPart>& of_interface, const Row& row) {
  const auto value_of = [&](const std::string& name) -> const Literal* {
    const Literal* const found = find_value(own, name);
    return found != nullptr || !of_interface ? found : find_value(*of_interface, name);
  };
  for (std::size_t i = 0; i < own.block.parameters.size() && i < own.values.size(); ++i) {
    const Parameter& parameter = own.block.parameters[i];
    // A default is the table's own, whatever the rows say.
    if (own.values[i].position == parameter.initial.position || !is_set(own.values[i])) continue;
    for (const Need& condition : parameter.conditions) {
      const Literal* const other = value_of(condition.field);
      if (other == nullptr) continue;
      if ((condition.numbers >> static_cast<unsigned>(number_of(*other)) & 1U) != 0) continue;
      assembly.diagnostics.error(
          own.values[i].position,
          quote("configuration." + parameter.field.name) + " of " + row.name() + " " + condition.reason,
          "remove it, or change " + quote("configuration." + condition.field) + "; " +
              quote(parameter.field.name) + " is declared at " + to_string(parameter.field.position));
    }
  }
}

void mark_broken_places(Assembly& assembly, const Node& table, const Scope& scope) {
  for (const char* direction : {"in", "out"}) {
    const Node* section = table.find(direction);
    if (section == nullptr) continue;
    for (const Node& child : section->children)
      if (child.kind == Node::Kind::text)
        assembly.broken_places.insert(array_base(scope.slot_name(child.text)));
  }
}

void mark_broken(Assembly& assembly, const FlatRow& row) {
  assembly.broken_owners.insert(row.scope->prefix + row.node->key);
  mark_broken_places(assembly, *row.node, *row.scope);
  // Of a device also what its drivers name.
  for (const Node& child : row.node->children) mark_broken_places(assembly, child, *row.scope);
  for (const PortBinding& binding : row.scope->bindings)
    if (binding.target == row.node->key || binding.target.starts_with(row.node->key + "."))
      assembly.broken_places.insert(array_base(binding.slot));
  if (const Node* section = row.node->find("device"))
    for (const Node& child : section->children)
      if (child.kind == Node::Kind::text) assembly.broken_owners.insert(row.scope->prefix + child.text);
}

}  // namespace flexrf::config_gen
