// `parameter.P = {...}` of units and devices: what an application changes in how the panel shows a parameter,
// and the narrower range that is then enforced.
#include <algorithm>

#include "config-gen/model/words.hpp"
#include "config-gen/read/assembly.hpp"
#include "config-gen/read/literal.hpp"
#include "config-gen/read/widget_kinds.hpp"

namespace flexrf::config_gen {
namespace {

const Parameter* find_parameter(const std::vector<const ParameterBlock*>& blocks, const std::string& name) {
  for (const ParameterBlock* block : blocks)
    for (const Parameter& parameter : block->parameters)
      if (parameter.field.name == name) return &parameter;
  return nullptr;
}

void read_override_range(Assembly& assembly, Row& row, const Parameter& parameter,
                         ParameterOverride& change) {
  const Node* range = row.any("range");
  if (range == nullptr) return;
  if (range->kind != Node::Kind::array || range->children.size() != 2) {
    assembly.diagnostics.error(range->position, "'range' of " + row.name() + " must be a list of two numbers",
                               "write it as [lowest, highest]");
    return;
  }
  if (parameter.kind == Parameter::Kind::feedback || parameter.input != Parameter::Input::value ||
      parameter.field.type.kind != FieldType::Kind::scalar ||
      parameter.field.type.scalar == Scalar::boolean || parameter.field.type.scalar == Scalar::text) {
    assembly.diagnostics.error(range->position,
                               quote(parameter.field.name) + " cannot have a range in " + row.name(),
                               "only numbers that can be set have one: remove it");
    return;
  }
  Parameter bound = parameter;
  bound.field.shape.clear();
  const std::string what = "a bound of the range of " + row.name();
  auto low = read_parameter_value(assembly.model, bound, range->children[0], what, assembly.diagnostics);
  auto high = read_parameter_value(assembly.model, bound, range->children[1], what, assembly.diagnostics);
  if (!low || !high ||
      !check_range(*low, *high, range->position, "the range of " + row.name(), assembly.diagnostics))
    return;
  low->position = high->position = range->position;
  change.low = std::move(low);
  change.high = std::move(high);
}

}  // namespace

std::vector<ParameterOverride> read_overrides(Assembly& assembly, const Node* table,
                                              const std::vector<const ParameterBlock*>& blocks,
                                              const std::string& owner, const std::string& row_name) {
  std::vector<ParameterOverride> changes;
  if (table == nullptr) return changes;
  for (const Node& child : table->children) {
    const Parameter* parameter = find_parameter(blocks, child.key);
    if (parameter == nullptr) {
      std::vector<std::string> known;
      for (const ParameterBlock* block : blocks)
        for (const Parameter& one : block->parameters) known.push_back(one.field.name);
      assembly.diagnostics.error(child.key_position, "unknown parameter " + quote(child.key) + " of " + owner,
                                 suggest(child.key, known, "parameters", "it has none: remove this line"));
      continue;
    }
    if (child.kind != Node::Kind::table) {
      assembly.diagnostics.error(child.position,
                                 quote("parameter." + child.key) + " of " + row_name +
                                     " must be a table, not " + kind_text(child.kind),
                                 "write it as { label = \"Speed\" }");
      continue;
    }
    Row row(child, quote("parameter." + child.key) + " of " + row_name, assembly.diagnostics);
    ParameterOverride change;
    change.parameter = child.key;
    change.kind = parameter->kind;
    change.position = child.key_position;
    change.label = row.text("label");
    change.hidden = row.boolean("hidden");
    change.widget = row.text("widget");
    change.widget_position = row.position("widget");
    change.menu = row.text("menu");
    change.place = row.text("place");
    change.place_position = row.position("place");
    change.confirm = row.text("confirm");
    read_override_range(assembly, row, *parameter, change);
    if (change.widget) {
      const std::string needs =
          widget_misfit(assembly.model, *change.widget, *parameter, change.low.has_value());
      if (!needs.empty())
        assembly.diagnostics.error(change.widget_position,
                                   "the widget " + quote(*change.widget) + " cannot show " +
                                       quote(child.key) + " of " + owner + ": it needs " + needs,
                                   "remove it, and the page shows the usual one");
    }
    change.step = read_step(assembly.model, row, *parameter, assembly.diagnostics);
    row.finish();
    changes.push_back(std::move(change));
  }
  return changes;
}

void check_narrowed(Assembly& assembly, const std::vector<ParameterOverride>& changes,
                    const ParameterBlock& block, const std::vector<Literal>& values) {
  for (const ParameterOverride& change : changes) {
    if (!change.low || !change.high) continue;
    for (std::size_t i = 0; i < block.parameters.size() && i < values.size(); ++i) {
      const Parameter& parameter = block.parameters[i];
      if (parameter.field.name != change.parameter || parameter.kind != change.kind) continue;
      const auto judge = [&](const Literal& value) {
        if (!is_below(value, *change.low) && !is_below(*change.high, value)) return true;
        assembly.diagnostics.error(change.low->position,
                                   "the range of " + quote("parameter." + change.parameter) +
                                       " leaves out the value " + literal_text(value) +
                                       " that it starts with",
                                   "widen the range, or give a value inside at " + to_string(value.position));
        return false;
      };
      if (parameter.field.shape.empty()) {
        judge(values[i]);
      } else {
        // Once for a whole array.
        static_cast<void>(std::all_of(values[i].elements.begin(), values[i].elements.end(), judge));
      }
    }
  }
}

}  // namespace flexrf::config_gen
