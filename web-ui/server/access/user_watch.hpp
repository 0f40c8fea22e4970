// Notices that the file of users has changed while the application runs.
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "base/time.hpp"
#include "web-ui/server/access/file_watch.hpp"
#include "web-ui/server/access/user_file.hpp"

namespace flexrf::panel {

/// The server's thread; looks by one system call, and reads (at most some 10 KB) only what has changed.
class UserFileWatch {
 public:
  static constexpr Duration interval = FileWatch::interval;

  /// Before the file is read for the first time; empty: there is none. Any one thread.
  explicit UserFileWatch(std::string file = "") : watch_(std::move(file)) {}

  /// The users from now on, when the file has changed (FileWatch). Null: as before, which is so too, with a
  /// line in the log, when it is damaged, readable by others, or gone: nobody is shut out by a slip.
  std::optional<Users> update(Time now);

 private:
  FileWatch watch_;
};

}  // namespace flexrf::panel
