// A refusal as HTTP and the live connection tell it (RFC 9457).
#pragma once

#include "base/json_writer.hpp"
#include "runtime/face/refusal.hpp"
#include "web-ui/server/exchange.hpp"

namespace flexrf::panel {

/// One JSON object.
void write_problem(JsonWriter& json, const Refusal& refusal);
/// Makes the reply that refusal: status, Retry-After where trying again helps, body.
void write_problem(Reply& reply, const Refusal& refusal);

}  // namespace flexrf::panel
