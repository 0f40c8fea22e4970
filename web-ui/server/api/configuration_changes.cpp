#include "web-ui/server/api/configuration_changes.hpp"

#include <algorithm>

#include "runtime/face/change.hpp"
#include "runtime/parameters/value_access.hpp"

namespace flexrf::panel {
namespace {

/// A structure has no text: it is written as its members, each with a path of its own.
void add_leaves(const FieldPlace& place, const std::string& path, const std::byte* structure,
                ComponentIndex component, std::vector<ConfigurationChange>& changes) {
  const FieldDescriptor& field = *place.field;
  if (field.scalar != Scalar::structure) {
    changes.push_back({component, path, text_of(place, structure)});
    return;
  }
  for (std::uint32_t i = 0; i < place.count; ++i) {
    std::string element = path;
    if (field.dimensions == 1 && !place.is_element) element += '[' + std::to_string(i) + ']';
    if (field.dimensions == 2 && !place.is_element) {
      element += '[' + std::to_string(i % field.shape[0]) + "][" + std::to_string(i / field.shape[0]) + ']';
    }
    for (const FieldDescriptor& member : field.type->fields) {
      FieldPlace below = whole(member);
      below.offset += place.offset + i * field.type->size;
      add_leaves(below, element + '.' + member.name, structure, component, changes);
    }
  }
}

void read_component(const ComponentEntry& entry, ComponentIndex component, JsonObject values,
                    WantedChanges& wanted) {
  const ParameterBlock& block = entry.type->configuration;
  std::vector<std::byte> structure(block.type == nullptr ? 0 : block.type->size);
  for (const auto member : values) {
    ParameterPlace found;
    if (const auto refusal = read_parameter(block, "configuration", entry, member.key, member.value,
                                            structure.data(), found)) {
      wanted.causes.emplace_back(refusal->detail());
      continue;
    }
    wanted.role = std::max(wanted.role, found.parameter->role);
    add_leaves(found.place, std::string{member.key}, structure.data(), component, wanted.changes);
  }
}

}  // namespace

WantedChanges read_changes(const Directory& directory, JsonArray changes) {
  WantedChanges wanted;
  for (const JsonElement element : changes) {
    JsonObject object;
    if (element.get(object) != simdjson::SUCCESS) {
      wanted.causes.emplace_back("a change is an object {\"component\", \"values\": {...}}");
      continue;
    }
    Fields fields(object);
    const std::string_view name = fields.text("component");
    const std::optional<JsonObject> values = fields.object("values");
    if (!fields.status()) {
      wanted.causes.emplace_back(fields.status().cause());
      continue;
    }
    const std::optional<ComponentIndex> component = directory.component(name);
    if (!component) {
      wanted.causes.emplace_back(directory.no_component(name).detail());
      continue;
    }
    wanted.components.push_back(*component);
    read_component(directory.entry(*component), *component, *values, wanted);
  }
  return wanted;
}

}  // namespace flexrf::panel
