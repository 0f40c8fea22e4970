#include "config-gen/read/members.hpp"

#include <algorithm>
#include <map>

#include "config-gen/model/layout.hpp"
#include "config-gen/model/words.hpp"

namespace flexrf::config_gen {
namespace {

// Members of Component, of Unit or Device, and of every generated base.
const std::vector<std::string>& inherited_by(Heir heir) {
  static const std::vector<std::string> common = {
      "accept",  "accept_runtime", "clear_fault", "component_type",    "configuration", "connect",
      "fail",    "fault",          "feedback",    "initialise",        "name",          "parameter_memory",
      "runtime", "set_fault",      "set_name",    "set_type_in_force", "stop",          "type_in_force"};
  static const auto with = [](std::vector<std::string> more) {
    more.insert(more.end(), common.begin(), common.end());
    return more;
  };
  static const std::vector<std::string> unit =
      with({"cell", "cell_access", "input_counters", "is_idle", "reset", "step"});
  static const std::vector<std::string> device =
      with({"bus", "descriptor", "environment", "input_counters", "is_closed", "is_inhibited", "make_safe",
            "next_event", "options", "receive", "send", "set_environment", "set_inhibited"});
  return heir == Heir::unit ? unit : device;
}

std::vector<std::string> accessors_of(const Field& field) {
  if (field.type.kind != FieldType::Kind::scalar) return {};
  if (field.type.scalar == Scalar::text) return {field.name + "_view", "set_" + field.name};
  if (is_floating(field.type.scalar) && !field.shape.empty()) return {field.name + "_map"};
  return {};
}

}  // namespace

void add_members(const Node& table, std::string_view section, const std::string& kind,
                 std::vector<std::pair<std::string, const Node*>>& members) {
  const Node* rows = table.find(section);
  if (rows == nullptr || rows->kind != Node::Kind::table) return;
  for (const Node& node : rows->children) members.emplace_back(kind, &node);
}

void check_members(Heir heir, const std::vector<std::pair<std::string, const Node*>>& members,
                   Diagnostics& diagnostics) {
  const std::vector<std::string>& inherited = inherited_by(heir);
  std::map<std::string, std::pair<std::string, const Node*>> taken;
  for (const auto& [kind, node] : members) {
    if (std::find(inherited.begin(), inherited.end(), node->key) != inherited.end()) {
      diagnostics.error(node->key_position,
                        kind + " cannot be named " + quote(node->key) + ": every " +
                            (heir == Heir::unit ? "unit" : "device") + " has a member of this name",
                        "choose another name");
      continue;
    }
    const auto [first, is_new] = taken.try_emplace(node->key, kind, node);
    if (!is_new)
      diagnostics.error(
          node->key_position,
          "the name " + quote(node->key) + " is used twice: " + first->second.first + " and " + kind,
          "both become members of one class: rename one; the other is at " +
              to_string(first->second.second->key_position));
  }
}

void check_fields(const std::vector<const Field*>& fields, Diagnostics& diagnostics,
                  const std::vector<const Field*>& before) {
  using Accessors = std::map<std::string, const Field*>;
  const auto accessors = [](const std::vector<const Field*>& of) {
    Accessors found;
    for (const Field* field : of)
      for (const std::string& accessor : accessors_of(*field)) found.emplace(accessor, field);
    return found;
  };
  const auto check = [&diagnostics](const Field& field, const Accessors& taken) {
    const auto other = taken.find(field.name);
    if (other != taken.end())
      diagnostics.error(field.position,
                        quote(field.name) + " cannot stand beside " + quote(other->second->name) +
                            ", whose accessor has this name",
                        "rename one; the other is at " + to_string(other->second->position));
  };
  const Accessors own = accessors(fields);
  const Accessors earlier = accessors(before);
  for (const Field* field : fields) check(*field, own);
  for (const Field* field : fields) check(*field, earlier);
  for (const Field* field : before) check(*field, own);
}

}  // namespace flexrf::config_gen
