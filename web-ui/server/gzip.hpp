// Compressing what is sent often and never changes.
#pragma once

#include <string>
#include <string_view>

namespace flexrf::panel {

/// `bytes` as gzip (RFC 1952) with a header as gunzip() wants it; empty where that saves less than a tenth,
/// or less than a packet. Takes some 30 ms a MB: once, at the start. Any thread.
std::string gzip(std::string_view bytes);

}  // namespace flexrf::panel
