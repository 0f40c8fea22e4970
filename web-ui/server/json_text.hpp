// Text as a JSON string, appended to what is there.
#pragma once

#include <string>
#include <string_view>

namespace flexrf::panel {

/// Appends `text` in quotation marks, escaped as RFC 8259 wants it; bytes that are no UTF-8 become U+FFFD.
/// Allocates only when `json` has no room left. Any thread.
void append_json_text(std::string& json, std::string_view text);

}  // namespace flexrf::panel
