// What the helper asks of others, so that a test can be they.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "base/time.hpp"
#include "image/helper/interfaces.hpp"
#include "image/helper/panel_health.hpp"

namespace flexrf::helper {

/// Each may be called by several threads at a time.
struct Surroundings {
  /// Blocks, for each of some steps up to `wait`.
  std::function<PanelAnswer(Duration wait)> ask_panel;
  std::function<void(const std::string& line)> say;
  /// systemd's tool with these arguments. Empty: done; else why not, in one line. Blocks.
  std::function<std::string(const std::vector<std::string>& arguments)> systemctl;
  /// Free space of the file system that the folder is in, for root, bytes.
  std::function<std::uint64_t(const std::string& folder)> free_bytes;
  std::function<std::vector<Interface>()> interfaces;
};

}  // namespace flexrf::helper
