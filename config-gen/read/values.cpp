// Values that an application's rows give to parameters.
#include "config-gen/model/words.hpp"
#include "config-gen/read/assembly.hpp"
#include "config-gen/read/literal.hpp"

namespace flexrf::config_gen {

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
