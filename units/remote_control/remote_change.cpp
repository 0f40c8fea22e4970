#include "units/remote_control/remote_change.hpp"

#include "runtime/core/nearest_name.hpp"
#include "runtime/json/value_reader.hpp"
#include "runtime/parameters/parameter_store.hpp"
#include "runtime/parameters/scalar_types.hpp"

namespace flexrf::remote {
namespace {

constexpr std::uint64_t most_presses = 100;
/// A token makes whoever gives it an operator, and no more.
constexpr Role role_of_scripts = Role::operator_;

struct Found {
  const ParameterDescriptor* parameter = nullptr;
  std::uint16_t index = no_parameter;
  FieldPlace place;

  std::uint32_t offset() const noexcept { return place.offset - parameter->field->offset; }
};

std::optional<RpcProblem> find(const ChangedComponent& component, std::string_view path, Found& found) {
  const ParameterBlock& block = component.type.runtime;
  const std::string_view name = path.substr(0, path.find_first_of(".["));
  NearestName nearest(name);
  for (std::size_t i = 0; i < block.parameters.size(); ++i) {
    nearest.offer(block.parameters[i].field->name);
    if (name != block.parameters[i].field->name) continue;
    const Result<FieldPlace> place = find_field(*block.type, path);
    if (!place) {
      return RpcProblem{RpcError::not_found, std::string{component.name} + ": " + place.status().cause(),
                        "a path is gain, gains[2], limits.low"};
    }
    found = {&block.parameters[i], static_cast<std::uint16_t>(i), *place};
    if (found.parameter->role <= role_of_scripts) return std::nullopt;
    return RpcProblem{RpcError::role_missing,
                      std::string{component.name} + "." + std::string{shown(path)} +
                          " is for engineers or administrators, and scripts are operators",
                      "a person changes it in the panel"};
  }
  return RpcProblem{
      RpcError::not_found,
      std::string{component.name} + " has no runtime parameter '" + std::string{shown(path)} + "'",
      nearest_hint(nearest.best(), R"(the method list names them: {"of": "parameters", "component": NAME})")};
}

RpcProblem too_many(const ChangedComponent& component) {
  return {RpcError::too_large,
          std::string{component.name} + ": one request takes at most " +
              std::to_string(ParameterRequest::max_changes) + " values and " +
              std::to_string(ParameterRequest::max_value_bytes) + " bytes of them",
          "split it into several"};
}

}  // namespace

std::optional<RpcProblem> read_set(Fields& params, const ChangedComponent& component,
                                   ParameterRequest& request) {
  const auto values = params.object("values");
  if (params.has("expected")) request.expected = params.integer("expected");
  if (!params.status()) return wrong_params(params, R"(write {"component": NAME, "values": {PATH: value}})");
  // The struct that find_field() counts its offsets in; only what a path names is written and read.
  alignas(cache_line) std::byte structure[max_runtime_size];
  for (const auto member : *values) {
    Found found;
    if (auto problem = find(component, member.key, found)) return problem;
    ValueRange range{};
    const bool is_member = member.key.find('.') != std::string_view::npos;
    const Status status = read_value(member.value, found.place, structure,
                                     is_member ? nullptr : range_of(*found.parameter, range));
    if (!status) {
      return RpcProblem{
          RpcError::refused,
          std::string{component.name} + "." + std::string{shown(member.key)} + ": " + status.cause(),
          "nothing was changed"};
    }
    const FieldDescriptor& field = *found.place.field;
    const std::size_t size =
        field.scalar == Scalar::text ? field.count : found.place.count * element_size(field);
    if (!request.add(found.index, found.offset(), structure + found.place.offset, size))
      return too_many(component);
  }
  if (request.change_count > 0) return std::nullopt;
  return RpcProblem{RpcError::invalid_params, "'values' is empty", R"(write {"values": {PATH: value}})"};
}

std::optional<RpcProblem> read_press(Fields& params, const ChangedComponent& component,
                                     ParameterRequest& request) {
  const std::string_view path = params.text("parameter");
  const std::uint64_t count = params.integer_or("count", 1);
  if (!params.status())
    return wrong_params(params, R"(write {"component": NAME, "parameter": NAME, "count": 1})");
  if (count < 1 || count > most_presses) {
    return RpcProblem{RpcError::invalid_params, "'count' is " + std::to_string(count),
                      "it lies from 1 to " + std::to_string(most_presses)};
  }
  Found found;
  if (auto problem = find(component, path, found)) return problem;
  const Scalar scalar = found.place.field->scalar;
  if (scalar != Scalar::button) {
    return RpcProblem{
        RpcError::refused,
        std::string{component.name} + "." + std::string{shown(path)} + " cannot be pressed: it is no button",
        scalar == Scalar::hold ? "it is to be held, which only a person in the panel can"
                               : "write it by the method set"};
  }
  const auto presses = static_cast<std::uint32_t>(count);
  request.kind = RequestKind::press;
  if (!request.add(found.index, found.offset(), &presses, sizeof(presses))) return too_many(component);
  return std::nullopt;
}

RpcProblem problem_of(const ParameterAnswer& answer, const ChangedComponent& component) {
  const std::string name = component.name;
  if (answer.kind == AnswerKind::busy)
    return {RpcError::busy, name + " has too many requests waiting", "try again in a moment"};
  if (answer.kind == AnswerKind::stale) {
    return {
        RpcError::stale,
        name + ": somebody changed its settings since; their sequence is " + std::to_string(answer.sequence),
        "read them again"};
  }
  if (answer.kind == AnswerKind::unmet && answer.parameter != no_parameter) {
    return {RpcError::refused,
            name + "." + component.type.runtime.parameters[answer.parameter].field->name +
                " has no effect now: " + answer.reason,
            "nothing was changed; try again when that is so"};
  }
  if (answer.parameter == no_parameter)
    return {RpcError::refused, name + " refuses: " + answer.reason, "nothing was changed"};
  return {RpcError::refused,
          name + "." + component.type.runtime.parameters[answer.parameter].field->name + ": " + answer.reason,
          "nothing was changed"};
}

}  // namespace flexrf::remote
