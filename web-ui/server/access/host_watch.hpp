// Notices that the file of declared hosts has changed while the application runs.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/time.hpp"
#include "web-ui/server/access/file_watch.hpp"

namespace flexrf::panel {

/// One thread at a time; looks by one system call, and reads (at most some 2 KB, as it is written) only what
/// has changed.
class HostFileWatch {
 public:
  /// Before the file is read for the first time; empty: there is none.
  explicit HostFileWatch(std::string file = "") : watch_(std::move(file)) {}

  /// The declared hosts: none if there is no file. A damaged line does not count, and is a warning in the
  /// log. Null, with a warning: the file cannot be read. Blocks.
  std::optional<std::vector<std::string>> read() const;
  /// The declared hosts from now on, when the file has changed (FileWatch). Null: as before.
  std::optional<std::vector<std::string>> update(Time now);

 private:
  FileWatch watch_;
};

}  // namespace flexrf::panel
