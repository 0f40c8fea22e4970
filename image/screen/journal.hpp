// The lines of the PC's own services, from the journal.
#pragma once

#include <sys/types.h>

#include <deque>
#include <string>

namespace flexrf::screen {

/// Follows the journal by a program of systemd's, which is started anew when it ends. One thread.
class Journal {
 public:
  static constexpr std::size_t most_lines = 60;

  Journal() = default;
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;
  ~Journal();

  /// Takes what has come; never waits. @returns whether something had.
  bool take();
  /// The newest last.
  const std::deque<std::string>& lines() const noexcept { return lines_; }

 private:
  void start();
  void end();

  int pipe_ = -1;
  pid_t child_ = -1;
  std::string begun_;  // a line of which the end has not come
  std::deque<std::string> lines_;
};

}  // namespace flexrf::screen
