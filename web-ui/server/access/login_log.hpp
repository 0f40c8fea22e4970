// Failed logins, as the log tells them.
#pragma once

#include <array>
#include <string_view>

namespace flexrf::panel {

/// A name as somebody typed it, safe to be shown: in quotation marks, whatever is no printable ASCII
/// character as `\x1b`, cut after 32 bytes with `...`. Zero-terminated.
using ShownName = std::array<char, 4 * 32 + 6>;
ShownName shown_name(std::string_view name) noexcept;

/// Says who failed from where, at most once a second; what was held back is counted. Any thread.
void log_failed_login(const ShownName& name, std::string_view address) noexcept;
/// The same for the address that the application printed, whose token was wrong or used already.
void log_failed_token(std::string_view address) noexcept;

}  // namespace flexrf::panel
