// What a script may change: requests made of what it writes, and what the answers to them mean.
#pragma once

#include <optional>
#include <string_view>

#include "runtime/executive/cell.hpp"
#include "units/remote_control/rpc.hpp"

namespace flexrf::remote {

/// What a request changes, by names.
struct ChangedComponent {
  const char* name;
  const ComponentType& type;
};

/// {"values": {PATH: value}, "expected"}: runtime parameters, all or none. Nothing is sent.
std::optional<RpcProblem> read_set(Fields& params, const ChangedComponent& component,
                                   ParameterRequest& request);
/// {"parameter", "count"}: a button.
std::optional<RpcProblem> read_press(Fields& params, const ChangedComponent& component,
                                     ParameterRequest& request);
/// Of an answer that is no acceptance.
RpcProblem problem_of(const ParameterAnswer& answer, const ChangedComponent& component);

}  // namespace flexrf::remote
