#include "units/remote_control/remote_view.hpp"

#include <algorithm>
#include <iterator>

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

// ---- entries of lists

void list_slot(JsonWriter& json, const Directory& directory, std::size_t index) {
  const SlotRecord& slot = directory.slots()[index];
  json.member("name", slot.name).member("type", slot.control->type()->name);
  json.member("observed", slot.observer != nullptr);
}

void list_component(JsonWriter& json, const Directory& directory, std::size_t index) {
  const ComponentEntry& entry = directory.entry(static_cast<ComponentIndex>(index));
  json.member("name", entry.name).member("kind", entry.record->kind).member("type", entry.type->name);
}

void list_queue(JsonWriter& json, const Directory& directory, std::size_t index) {
  const QueueRecord& queue = directory.queues()[index];
  json.member("name", queue.name).member("type", queue.type->name).member("capacity", queue.capacity);
}

void list_thread(JsonWriter& json, const Directory& directory, std::size_t index) {
  const ThreadRecord& thread = directory.threads()[index];
  json.member("name", thread.name).member("priority", thread.priority);
}

struct Kind {
  const char* one;   ///< as `read` names it
  const char* many;  ///< as `list` names them
  Part part;
  void (*list)(JsonWriter& json, const Directory& directory, std::size_t index);
};

constexpr Kind kinds[] = {{"slot", "slots", Part::slot, list_slot},
                          {"component", "components", Part::component, list_component},
                          {"queue", "queues", Part::queue, list_queue},
                          {"thread", "threads", Part::thread, list_thread}};

/// Beside these there is a list of the parameters of a component.
constexpr const char* parameters = "parameters";

struct Listed {
  const char* kind;
  const ParameterDescriptor* parameter;
};

std::vector<Listed> parameters_of(const ComponentType& type) {
  std::vector<Listed> all;
  const auto add = [&all](const char* kind, const ParameterBlock& block) {
    for (const ParameterDescriptor& parameter : block.parameters) all.push_back({kind, &parameter});
  };
  add("configuration", type.configuration);
  add("runtime", type.runtime);
  add("feedback", type.feedback);
  return all;
}

void list_parameter(JsonWriter& json, const Listed& listed) {
  const ParameterDescriptor& parameter = *listed.parameter;
  const FieldDescriptor& field = *parameter.field;
  json.member("name", field.name).member("kind", listed.kind).member("type", type_of(field));
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

}  // namespace

std::optional<RpcProblem> RemoteView::find(Part part, std::string_view name, std::uint16_t& index) const {
  const std::optional<std::uint16_t> found = directory_.find(part, name);
  if (!found) return problem_of(directory_.unknown(part, name));
  index = *found;
  return std::nullopt;
}

std::optional<RpcProblem> RemoteView::too_much(std::uint16_t slot) const {
  const SlotRecord& record = directory_.slots()[slot];
  const TypeDescriptor& type = *record.control->type();
  if (!type.is_image && type.size <= largest_value) return std::nullopt;
  return RpcProblem{RpcError::too_large, "'" + std::string{record.name} + "' holds a picture, or too much",
                    "look at it in the panel"};
}

// ---- list

std::optional<RpcProblem> RemoteView::list(Fields& params, JsonWriter& json, std::size_t room) {
  const std::string_view of = params.text("of");
  const std::uint64_t from = params.integer_or("from", 0);
  const std::string_view name = of == parameters ? params.text("component") : std::string_view{};
  if (!params.status()) {
    return wrong_params(params, R"(write {"of": "slots"}, "components", "queues", "threads", )"
                                R"(or "parameters" and "component")");
  }
  const Kind* const kind = std::ranges::find(kinds, of, &Kind::many);
  std::vector<Listed> listed;
  if (of == parameters) {
    ComponentIndex component = 0;
    if (auto problem = find(Part::component, name, component)) return problem;
    listed = parameters_of(*entry(component).type);
  } else if (kind == std::end(kinds)) {
    NearestName nearest(of);
    for (const Kind& known : kinds) nearest.offer(known.many);
    nearest.offer(parameters);
    return RpcProblem{
        RpcError::invalid_params, "there is no list of '" + std::string{shown(of)} + "'",
        nearest_hint(nearest.best(), "there are slots, components, queues, threads and parameters")};
  }
  const std::size_t count = of == parameters ? listed.size() : directory_.count(kind->part);
  // One after the other until the answer is full; the writer cannot say how long it is, so each is made
  // apart.
  std::string entries;
  std::uint64_t next = from;
  for (; next < count; ++next) {
    JsonWriter entry(std::string{}, JsonWriter::Style::compact);
    entry.begin_object();
    of == parameters ? list_parameter(entry, listed[next]) : kind->list(entry, directory_, next);
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

// ---- read

void RemoteView::write_slot(JsonWriter& json, std::uint16_t slot, const ObservedSlot& seen) const {
  const SlotRecord& record = directory_.slots()[slot];
  json.member("name", record.name).member("type", record.control->type()->name);
  write_observed(json, *record.control->type(), seen, slots_.reason(slot, seen));
}

std::optional<RpcProblem> RemoteView::read(Fields& params, JsonWriter& json) {
  const auto is_asked = [&params](const Kind& kind) { return params.has(kind.one); };
  if (std::ranges::count_if(kinds, is_asked) != 1) {
    return RpcProblem{RpcError::invalid_params,
                      "none or several of 'slot', 'component', 'queue' and 'thread' are there",
                      R"(write {"slot": NAME}, {"component": NAME}, {"queue": NAME} or {"thread": NAME})"};
  }
  const Kind& asked = *std::ranges::find_if(kinds, is_asked);
  const std::string_view name = params.text(asked.one);
  if (!params.status()) return wrong_params(params, "write its name as a text");
  std::uint16_t index = 0;
  if (auto problem = find(asked.part, name, index)) return problem;
  if (asked.part == Part::slot) {
    if (auto problem = too_much(index)) return problem;
  }
  json.begin_object();
  switch (asked.part) {
    case Part::component:
      values_.write_all(json, index);
      break;
    case Part::slot:
      write_slot(json, index, look(index));
      break;
    case Part::queue: {
      const QueueFigures queue = statistics_.queue(index);
      json.member("name", queue.record->name).member("type", queue.record->type->name);
      write_queue(json, queue);
      break;
    }
    case Part::thread:
      write_thread(json, statistics_.thread(index));
      break;
  }
  json.end_object();
  return std::nullopt;
}

void RemoteView::write_runtime(JsonWriter& json, ComponentIndex component) {
  json.begin_object().member("sequence", values_.sequence(component)).key("values");
  values_.write_runtime(json, component);
  json.end_object();
}

}  // namespace flexrf::remote
