// Notices that the file of users has changed while the application runs.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <optional>
#include <string>

#include "base/time.hpp"
#include "web-ui/server/access/user_file.hpp"

namespace flexrf::panel {

/// The server's thread; looks by one system call, and reads (at most some 10 KB) only what has changed.
class UserFileWatch {
 public:
  static constexpr Duration interval = std::chrono::milliseconds{500};

  /// Before the file is read for the first time; empty: there is none. Any one thread.
  explicit UserFileWatch(std::string file = "");

  /// The users from now on, when the file has changed and then been left alone for an interval: an editor may
  /// be halfway through it. Null: as before, which is so too, with a line in the log, when it is damaged,
  /// readable by others, or gone: nobody is shut out by a slip.
  std::optional<Users> update(Time now);

 private:
  struct Stamp {
    ino_t file = 0;
    off_t size = -1;
    std::int64_t changed_s = 0;
    std::int64_t changed_ns = 0;
    bool operator==(const Stamp&) const = default;
  };

  Stamp stamp() const noexcept;

  std::string file_;
  Stamp read_;  // what was read last
  Stamp seen_;
  Time next_{};
};

}  // namespace flexrf::panel
