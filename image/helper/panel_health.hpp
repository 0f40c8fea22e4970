// Asks the application's panel on this machine whether all is well.
#pragma once

#include <cstdint>
#include <string>

#include "base/time.hpp"

namespace flexrf::helper {

/// GET /api/v1/health over TLS at 127.0.0.1. Who answers has to have the key of `certificate_file`, so that
/// no other process can answer in its place. Empty: 200, all is well. Else why not, in one line of printable
/// characters: the panel's own words, or why there is no answer. Blocks, for each step up to `wait`. Signal
/// SIGPIPE has to be ignored.
std::string why_not_healthy(std::uint16_t port, const std::string& certificate_file, Duration wait);

}  // namespace flexrf::helper
