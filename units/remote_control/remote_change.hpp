// What a script may change: requests made of what it writes, and what it is told when they are refused.
#pragma once

#include <optional>

#include "runtime/face/change.hpp"
#include "units/remote_control/rpc.hpp"

namespace flexrf::remote {

/// {"values": {PATH: value}, "expected"}: runtime parameters, all or none. Nothing is sent.
std::optional<RpcProblem> read_set(Fields& params, const ComponentEntry& component,
                                   ParameterRequest& request);
/// {"parameter", "count"}: a button.
std::optional<RpcProblem> read_press(Fields& params, const ComponentEntry& component,
                                     ParameterRequest& request);
RpcProblem problem_of(const Refusal& refusal);

}  // namespace flexrf::remote
