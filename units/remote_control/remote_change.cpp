#include "units/remote_control/remote_change.hpp"

namespace flexrf::remote {
namespace {

/// A token makes whoever gives it an operator, and no more.
constexpr Role role_of_scripts = Role::operator_;

RpcError error_of(RefusalKind kind) noexcept {
  switch (kind) {
    case RefusalKind::bad_request:
    case RefusalKind::method_not_allowed:
    case RefusalKind::wrong_media_type:
      return RpcError::invalid_params;
    case RefusalKind::role_missing:
    case RefusalKind::control_missing:
      return RpcError::role_missing;
    case RefusalKind::not_found:
      return RpcError::not_found;
    case RefusalKind::stale:
      return RpcError::stale;
    case RefusalKind::too_large:
      return RpcError::too_large;
    case RefusalKind::busy:
      return RpcError::busy;
    case RefusalKind::no_answer:
      return RpcError::no_answer;
    case RefusalKind::wrong_state:
    case RefusalKind::moving:
    case RefusalKind::refused:
    case RefusalKind::not_stored:
      break;
  }
  return RpcError::refused;
}

/// Who may not change something is told so first, and learns no more.
std::optional<RpcProblem> judge(const ComponentEntry& component, Role role,
                                const std::optional<Refusal>& refusal) {
  if (role > role_of_scripts) {
    return RpcProblem{RpcError::role_missing,
                      std::string{component.name} +
                          ": one of these is for engineers or administrators, and scripts are operators",
                      "a person changes it in the panel"};
  }
  return refusal ? std::optional{problem_of(*refusal)} : std::nullopt;
}

}  // namespace

RpcProblem problem_of(const Refusal& refusal) {
  return {error_of(refusal.kind()), refusal.text(),
          refusal.hint()[0] != '\0' ? refusal.hint() : "nothing was changed"};
}

std::optional<RpcProblem> read_set(Fields& params, const ComponentEntry& component,
                                   ParameterRequest& request) {
  const auto values = params.object("values");
  if (params.has("expected")) request.expected = params.integer("expected");
  if (!params.status()) return wrong_params(params, R"(write {"component": NAME, "values": {PATH: value}})");
  if (values->size() == 0)
    return RpcProblem{RpcError::invalid_params, "'values' is empty", R"(write {"values": {PATH: value}})"};
  Role role = role_of_scripts;
  const auto refusal = add_values(component, *values, request, role);
  return judge(component, role, refusal);
}

std::optional<RpcProblem> read_press(Fields& params, const ComponentEntry& component,
                                     ParameterRequest& request) {
  const std::string_view path = params.text("parameter");
  const std::uint64_t count = params.integer_or("count", 1);
  if (!params.status())
    return wrong_params(params, R"(write {"component": NAME, "parameter": NAME, "count": 1})");
  Role role = role_of_scripts;
  const auto refusal = add_presses(component, path, count, request, role);
  return judge(component, role, refusal);
}

}  // namespace flexrf::remote
