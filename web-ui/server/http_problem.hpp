// Refusals of the server itself as clients get them: RFC 9457, "Problem Details for HTTP APIs".
#pragma once

#include <string_view>

#include "web-ui/server/exchange.hpp"

namespace flexrf::panel {

/// "Not Found" of 404; also what stands in a status line. Any thread.
std::string_view title_of(unsigned status) noexcept;

/// Makes a problem of type about:blank the whole reply; headers that were set (a cookie, Retry-After) stay.
/// `detail`: what happened and what to do, for a person. Any thread.
void answer_problem(Reply& reply, unsigned status, std::string_view detail);

}  // namespace flexrf::panel
