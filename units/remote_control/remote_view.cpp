#include "units/remote_control/remote_view.hpp"

#include "base/nearest_name.hpp"
#include "runtime/face/json_parts.hpp"
#include "units/remote_control/remote_change.hpp"

namespace flexrf::remote {
namespace {

constexpr std::size_t kept_for_the_rest = 512;  // bytes of an answer, beside its list

const char* type_of(const FieldDescriptor& field) noexcept {
  static constexpr const char* names[] = {"bool",        "i8",        "u8",     "i16", "u16", "i32",
                                          "u32",         "i64",       "u64",    "f32", "f64", "text",
                                          "enumeration", "structure", "button", "hold"};
  if (field.type != nullptr) return field.type->name;
  return names[static_cast<std::size_t>(field.scalar)];
}

}  // namespace

std::optional<RpcProblem> RemoteView::find_slot(std::string_view name, std::uint16_t& slot) const {
  const std::optional<std::uint16_t> found = directory_.slot(name);
  if (!found) return problem_of(directory_.no_slot(name));
  slot = *found;
  return std::nullopt;
}

std::optional<RpcProblem> RemoteView::find_component(std::string_view name, ComponentIndex& component) const {
  const std::optional<ComponentIndex> found = directory_.component(name);
  if (!found) return problem_of(directory_.no_component(name));
  component = *found;
  return std::nullopt;
}

std::optional<RpcProblem> RemoteView::too_much(std::uint16_t slot) const {
  const SlotRecord& record = application().slots[slot];
  const TypeDescriptor& type = *record.control->type();
  if (!type.is_image && type.size <= largest_value) return std::nullopt;
  return RpcProblem{RpcError::too_large, "'" + std::string{record.name} + "' holds a picture, or too much",
                    "look at it in the panel"};
}

// ---- list

std::optional<RpcProblem> RemoteView::list(Fields& params, JsonWriter& json, std::size_t room) {
  const std::string_view of = params.text("of");
  const std::uint64_t from = params.integer_or("from", 0);
  const std::string_view name = of == "parameters" ? params.text("component") : std::string_view{};
  if (!params.status())
    return wrong_params(params, R"(write {"of": "slots"}, "components", or "parameters" and "component")");
  const ParameterBlock* blocks[3] = {};
  std::uint64_t count = 0;
  if (of == "slots") {
    count = application().slots.size();
  } else if (of == "components") {
    count = directory_.component_count();
  } else if (of == "parameters") {
    ComponentIndex component = 0;
    if (auto problem = find_component(name, component)) return problem;
    const ComponentType& type = *directory_.entry(component).type;
    blocks[0] = &type.configuration, blocks[1] = &type.runtime, blocks[2] = &type.feedback;
    for (const ParameterBlock* block : blocks) count += block->parameters.size();
  } else {
    NearestName nearest(of);
    for (const char* const known : {"slots", "components", "parameters"}) nearest.offer(known);
    return RpcProblem{RpcError::invalid_params, "there is no list of '" + std::string{shown(of)} + "'",
                      nearest_hint(nearest.best(), "there are slots, components and parameters")};
  }
  // One after the other until the answer is full; the writer cannot say how long it is, so each is made
  // apart.
  std::string entries;
  std::uint64_t next = from;
  for (; next < count; ++next) {
    JsonWriter entry(std::string{}, JsonWriter::Style::compact);
    entry.begin_object();
    if (of == "slots") {
      const SlotRecord& slot = application().slots[next];
      entry.member("name", slot.name).member("type", slot.control->type()->name);
      entry.member("observed", slot.observer != nullptr);
    } else if (of == "components") {
      const auto component = static_cast<ComponentIndex>(next);
      const ComponentEntry& known = directory_.entry(component);
      entry.member("name", known.name).member("kind", known.record->kind).member("type", known.type->name);
    } else {
      static constexpr const char* kinds[] = {"configuration", "runtime", "feedback"};
      std::size_t kind = 0;
      std::size_t number = next;
      while (number >= blocks[kind]->parameters.size()) number -= blocks[kind++]->parameters.size();
      list_parameter(entry, kinds[kind], blocks[kind]->parameters[number]);
    }
    entry.end_object();
    const std::string text = entry.release();
    if (entries.size() + text.size() + kept_for_the_rest > room) break;
    if (!entries.empty()) entries += ',';
    entries += text;
  }
  json.begin_object().key(of).raw("[" + entries + "]").key("next");
  next < count ? json.value(next) : json.null();
  json.end_object();
  return std::nullopt;
}

void RemoteView::list_parameter(JsonWriter& json, const char* kind,
                                const ParameterDescriptor& parameter) const {
  const FieldDescriptor& field = *parameter.field;
  json.member("name", field.name).member("kind", kind).member("type", type_of(field));
  if (field.dimensions > 0) {
    json.key("shape").begin_array();
    for (std::uint8_t i = 0; i < field.dimensions; ++i) json.value(field.shape[i]);
    json.end_array();
  }
  if (field.unit[0] != '\0') json.member("unit", field.unit);
  if (parameter.has_range)
    json.key("range").begin_array().value(parameter.minimum).value(parameter.maximum).end_array();
  json.member("role", name_of(parameter.role));
}

// ---- read

void RemoteView::write_slot(JsonWriter& json, std::uint16_t slot, const ObservedSlot& seen) const {
  const SlotRecord& record = application().slots[slot];
  json.member("name", record.name).member("type", record.control->type()->name);
  write_observed(json, *record.control->type(), seen);
}

std::optional<RpcProblem> RemoteView::read(Fields& params, JsonWriter& json) {
  const bool of_slot = params.has("slot");
  if (of_slot == params.has("component")) {
    return RpcProblem{RpcError::invalid_params, "neither or both of 'slot' and 'component' are there",
                      R"(write {"slot": NAME} or {"component": NAME})"};
  }
  const std::string_view name = params.text(of_slot ? "slot" : "component");
  if (!params.status()) return wrong_params(params, "write its name as a text");
  if (!of_slot) {
    ComponentIndex component = 0;
    if (auto problem = find_component(name, component)) return problem;
    write_component(json, component);
    return std::nullopt;
  }
  std::uint16_t slot = 0;
  if (auto problem = find_slot(name, slot)) return problem;
  if (auto problem = too_much(slot)) return problem;
  const ObservedSlot& seen = look(slot);
  json.begin_object();
  write_slot(json, slot, seen);
  json.end_object();
  return std::nullopt;
}

void RemoteView::write_runtime(JsonWriter& json, ComponentIndex component) {
  json.begin_object().member("sequence", values_.sequence(component)).key("values");
  values_.write_runtime(json, component);
  json.end_object();
}

void RemoteView::write_component(JsonWriter& json, ComponentIndex component) {
  json.begin_object();
  values_.write_all(json, component);
  json.end_object();
}

}  // namespace flexrf::remote
