// The command line of flexrf-helper.
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "image/helper/files.hpp"
#include "image/helper/helper.hpp"

namespace flexrf::helper {

struct Options {
  Files files;
  Limits limits;
  std::uint16_t port = 8443;                         ///< the panel's
  std::string socket = "/run/flexrf-helper/socket";  ///< where requests come
  std::string peer = "flexrf";                       ///< the user that may ask, beside root
  std::string systemctl = "/usr/bin/systemctl";
  std::string journalctl = "/usr/bin/journalctl";
  bool wants_help = false;
};

/// The options, or what is wrong about them.
std::variant<Options, std::string> parse_options(const std::vector<std::string>& words);

extern const char* const usage;

}  // namespace flexrf::helper
