#include "runtime/face/change.hpp"

#include <algorithm>

#include "base/nearest_name.hpp"
#include "runtime/core/scalar_types.hpp"
#include "runtime/json/value_reader.hpp"
#include "runtime/parameters/parameter_store.hpp"

namespace flexrf {
namespace {

std::optional<Refusal> too_many(const ComponentEntry& component) noexcept {
  return Refusal::make(RefusalKind::too_large, "%s: one request takes at most %u values and %u bytes of them",
                       component.name, ParameterRequest::max_changes, ParameterRequest::max_value_bytes)
      .hint("split it into several");
}

int shown(std::string_view path) noexcept {
  return static_cast<int>(std::min<std::size_t>(path.size(), 80));
}

/// A button is pressed, a hold held, and each of them nothing else.
std::optional<Refusal> cannot_be(const char* act, const char* other, const ComponentEntry& component,
                                 std::string_view path, const char* hint) noexcept {
  return Refusal::make(RefusalKind::refused, "%s.%.*s cannot be %s: it is no %s", component.name, shown(path),
                       path.data(), act, other)
      .hint("%s", hint)
      .about(path);
}

/// Of a device, another of its drivers that has a parameter of this name; null: none has.
const char* driver_with(const ComponentEntry& component, ParameterBlock ComponentType::*kind,
                        std::string_view name) noexcept {
  for (const DriverRecord& driver : component.drivers)
    for (const ParameterDescriptor& parameter : (driver.type->*kind).parameters)
      if (name == parameter.field->name) return driver.name;
  return nullptr;
}

std::optional<Refusal> find_parameter(const ParameterBlock& block, const char* kind,
                                      const ComponentEntry& component, std::string_view path,
                                      ParameterPlace& found) noexcept {
  const std::string_view name = path.substr(0, path.find_first_of(".["));
  NearestName nearest(name);
  for (std::size_t i = 0; i < block.parameters.size(); ++i) {
    nearest.offer(block.parameters[i].field->name);
    if (name != block.parameters[i].field->name) continue;
    const Result<FieldPlace> place = find_field(*block.type, path);
    if (!place)
      return Refusal::make(RefusalKind::not_found, "%s: %s", component.name, place.status().cause())
          .about(path);
    found = {&block.parameters[i], static_cast<std::uint16_t>(i), *place};
    return std::nullopt;
  }
  const bool is_runtime = std::string_view{kind} == "runtime";
  if (const char* const other =
          driver_with(component, is_runtime ? &ComponentType::runtime : &ComponentType::configuration, name);
      other != nullptr) {
    Refusal refusal = Refusal::make(RefusalKind::wrong_state,
                                    "%s.%.*s is not there: the driver is '%s'; this belongs to '%s'",
                                    component.name, shown(path), path.data(), component.driver, other);
    return refusal.hint("a driver is chosen at the start, as --hardware %s=%s", component.name, other)
        .about(path);
  }
  Refusal refusal = Refusal::make(RefusalKind::not_found, "%s has no %s parameter '%.*s'", component.name,
                                  kind, shown(path), path.data());
  if (const std::string_view best = nearest.best(); !best.empty()) refusal.hint_nearest(best);
  return refusal.about(path);
}

}  // namespace

std::optional<Refusal> read_parameter(const ParameterBlock& block, const char* kind,
                                      const ComponentEntry& component, std::string_view path,
                                      JsonElement value, void* structure, ParameterPlace& found) noexcept {
  if (auto refusal = find_parameter(block, kind, component, path, found)) return refusal;
  ValueRange range{};
  const bool is_member = path.find('.') != std::string_view::npos;
  const Status status =
      read_value(value, found.place, structure, is_member ? nullptr : range_of(*found.parameter, range));
  if (status) return std::nullopt;
  return Refusal::make(RefusalKind::refused, "%s.%.*s is refused: %s", component.name, shown(path),
                       path.data(), status.cause())
      .about(path)
      .because(status.cause());
}

std::optional<Refusal> add_values(const ComponentEntry& component, JsonObject values,
                                  ParameterRequest& request, Role& role) noexcept {
  const ParameterBlock& block = component.type->runtime;
  // The struct that find_field() counts its offsets in; only what a path names is written and read.
  alignas(cache_line) std::byte structure[max_runtime_size];
  for (const auto member : values) {
    ParameterPlace found;
    if (auto refusal =
            read_parameter(block, "runtime", component, member.key, member.value, structure, found))
      return refusal;
    role = std::max(role, found.parameter->role);
    const std::size_t size = found.place.field->scalar == Scalar::text
                                 ? found.place.field->count
                                 : found.place.count * element_size(*found.place.field);
    if (!request.add(found.index, found.offset(), structure + found.place.offset, size))
      return too_many(component);
  }
  if (request.change_count > 0) return std::nullopt;
  return Refusal::make(RefusalKind::bad_request, "There is no value").hint("write {\"PATH\": value, ...}");
}

std::optional<Refusal> add_name(const ComponentEntry& component, std::string_view path,
                                ParameterRequest& request, Role& role) noexcept {
  ParameterPlace found;
  if (auto refusal = find_parameter(component.type->runtime, "runtime", component, path, found))
    return refusal;
  role = std::max(role, found.parameter->role);
  if (request.kind == RequestKind::hold && found.place.field->scalar != Scalar::hold)
    return cannot_be("held", "hold parameter", component, path, "nothing was changed");
  if (!request.add_name(found.index, found.offset())) return too_many(component);
  return std::nullopt;
}

std::optional<Refusal> add_presses(const ComponentEntry& component, std::string_view path,
                                   std::uint64_t count, ParameterRequest& request, Role& role) noexcept {
  ParameterPlace found;
  if (auto refusal = find_parameter(component.type->runtime, "runtime", component, path, found))
    return refusal;
  role = std::max(role, found.parameter->role);
  const Scalar scalar = found.place.field->scalar;
  if (scalar != Scalar::button) {
    return cannot_be(
        "pressed", "button", component, path,
        scalar == Scalar::hold ? "only a person who watches can hold it" : "it is set to a value");
  }
  if (count < 1 || count > most_presses) {
    return Refusal::make(RefusalKind::bad_request, "'count' lies from 1 to %llu",
                         static_cast<unsigned long long>(most_presses));
  }
  const auto presses = static_cast<std::uint32_t>(count);
  request.kind = RequestKind::press;
  if (!request.add(found.index, found.offset(), &presses, sizeof(presses))) return too_many(component);
  return std::nullopt;
}

Refusal refusal_of(const ParameterAnswer& answer, const ComponentEntry& component) noexcept {
  switch (answer.kind) {
    case AnswerKind::busy:
      return Refusal::make(RefusalKind::busy, "%s has too many requests waiting", component.name)
          .hint("try again in a moment");
    case AnswerKind::stale:
      return Refusal::make(RefusalKind::stale,
                           "%s: somebody changed its settings since you read them (now %llu)", component.name,
                           static_cast<unsigned long long>(answer.sequence))
          .hint("read them again");
    case AnswerKind::accepted:
    case AnswerKind::unmet:
    case AnswerKind::refused:
      break;
  }
  if (answer.parameter == no_parameter) {
    return Refusal::make(RefusalKind::wrong_state, "%s refuses: %s", component.name, answer.reason)
        .because(answer.reason);
  }
  const char* const parameter = component.type->runtime.parameters[answer.parameter].field->name;
  const bool is_unmet = answer.kind == AnswerKind::unmet;
  return Refusal::make(is_unmet ? RefusalKind::wrong_state : RefusalKind::refused, "%s.%s %s: %s",
                       component.name, parameter, is_unmet ? "has no effect now" : "is refused",
                       answer.reason)
      .about(parameter)
      .because(answer.reason);
}

Refusal no_answer(const ComponentEntry& component, Duration waited) noexcept {
  return Refusal::make(RefusalKind::no_answer, "%s did not answer within %.3g s", component.name,
                       seconds(waited))
      .hint("its thread may hang; whether it happened is not known, read the values");
}

}  // namespace flexrf
