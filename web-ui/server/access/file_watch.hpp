// Notices that a file has changed while the application runs.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <string>

#include "base/time.hpp"

namespace flexrf::panel {

/// One thread at a time; looks by one system call, and reads nothing itself.
class FileWatch {
 public:
  static constexpr Duration interval = std::chrono::milliseconds{500};

  /// Before the file is read for the first time; empty: there is none.
  explicit FileWatch(std::string file = "");

  const std::string& file() const noexcept { return file_; }
  /// Once for each change, when the file has been left alone for an interval since: an editor may be halfway
  /// through it. A file that is gone, or is there now, has changed, too.
  bool has_changed(Time now);

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
  Stamp told_;  // when it changed last
  Stamp seen_;
  Time next_{};
};

}  // namespace flexrf::panel
