// Asks the application's panel on this machine whether all is well, and whether anything may move.
#pragma once

#include <cstdint>
#include <string>

#include "base/time.hpp"

namespace flexrf::helper {

struct PanelAnswer {
  /// Empty: all is well. Else in one line of printable characters the panel's own words, or why there is no
  /// answer.
  std::string why_not_healthy;
  bool has_answered = false;  ///< whoever has the panel's key
  bool may_move = true;       ///< actuators, now; also when that is not told
};

/// GET /api/v1/health over TLS at 127.0.0.1. Who answers has to have the key of `certificate_file`, so that
/// no other process can answer in its place. Blocks, for each step up to `wait`. Any thread. Signal SIGPIPE
/// has to be ignored.
PanelAnswer ask_panel(std::uint16_t port, const std::string& certificate_file, Duration wait);

}  // namespace flexrf::helper
