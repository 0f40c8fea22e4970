// What the command line says of the panel.
#pragma once

#include <array>

#include "runtime/core/option.hpp"

namespace flexrf {
struct Options;
}

namespace flexrf::panel {

inline constexpr const char* default_listen_address = "127.0.0.1:8080";

extern const std::array<Option, 9> panel_options;

/// Whether there is to be a panel: not with `--panel off`, nor in virtual time. invalid_argument: it was
/// asked for and cannot be.
Result<bool> is_panel_wanted(const Options& options);

}  // namespace flexrf::panel
