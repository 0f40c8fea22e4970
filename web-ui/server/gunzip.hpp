// For the few clients that cannot do it themselves.
#pragma once

#include <string>
#include <string_view>

namespace flexrf::panel {

/// Appends what gzip (RFC 1952, one member) made smaller; false: it is broken. Any thread.
bool gunzip(std::string_view compressed, std::string& text);

}  // namespace flexrf::panel
