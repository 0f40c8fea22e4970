// A secret from whoever sits at the terminal.
#pragma once

#include <string>

#include "base/status.hpp"

namespace flexrf::panel {

/// On a terminal asks twice without showing what is typed; else one line of standard input. invalid_argument:
/// the two differ; closed: there was no line. Blocks.
Result<std::string> read_new_secret(const std::string& user);

}  // namespace flexrf::panel
