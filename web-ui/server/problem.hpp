// Errors as clients get them: RFC 9457, "Problem Details for HTTP APIs".
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "web-ui/server/exchange.hpp"

namespace flexrf::panel {

/// What went wrong. What is empty is left out. All functions: any thread.
struct Problem {
  unsigned status = 500;
  std::string_view detail;                   ///< what happened and what to do, for a person
  std::string_view name;                     ///< type "/problems/NAME"; empty: "about:blank"
  std::string_view parameter;                ///< path of the parameter that was refused
  std::string_view reason;                   ///< why it was, for a program
  std::span<const std::string_view> moving;  ///< components that move and should not
};

/// "Not Found" of 404; also what stands in a status line.
std::string_view title_of(unsigned status) noexcept;

/// Appends the problem as one JSON object.
void append_problem(std::string& json, const Problem& problem);

/// Makes it the whole reply; headers that were set (a cookie, Retry-After) stay.
void answer_problem(Reply& reply, const Problem& problem);

}  // namespace flexrf::panel
