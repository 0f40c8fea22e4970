// The audit's file: lines appended, old ones set aside, never more than a few MiB.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "base/status.hpp"

namespace flexrf {

/// PATH, and PATH.1 (newer) to PATH.3 (older) with what was before; each at most `largest` bytes. All
/// functions block: one thread that nobody waits for, but check() and last_lines() before there is one.
class AuditFile {
 public:
  static constexpr std::size_t largest = std::size_t{1} << 20;
  static constexpr int kept = 3;

  /// Empty: there is no file, and whatever is written is forgotten.
  explicit AuditFile(std::string path) : path_(std::move(path)) {}

  /// Whether lines can be appended: the cause says what is in the way. not_permitted: the place is there, but
  /// cannot be written.
  Status check() const;
  /// At most so many of the newest whole lines, oldest first; none where there is no file yet.
  std::vector<std::string> last_lines(std::size_t count) const;
  /// All of these lines (each with its line feed), or an error and the file is as it was. On the disk when it
  /// returns.
  Status append(std::string_view lines);

 private:
  void set_aside() const;

  std::string path_;
};

}  // namespace flexrf
