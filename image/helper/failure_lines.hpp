// The last lines that the application's unit left in the journal in some boots.
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "base/status.hpp"
#include "base/time.hpp"

namespace flexrf::helper {

inline constexpr std::size_t most_journal_lines = 20;
inline constexpr std::size_t longest_journal_line = 200;
inline constexpr std::size_t most_journal_bytes = 4096;

/// What journalctl is asked for: the lines of flexrf.service, and of systemd about it, from these boots, each
/// with the seconds since its kernel began.
std::vector<std::string> journal_arguments(const std::vector<std::string>& boots);
/// The last lines of its output, in printable ASCII, within the limits above.
std::vector<std::string> last_lines(std::string_view text);

/// Reads lines in a thread of its own, when they are asked for. Past boots get no further lines, so that it
/// reads once.
class FailureLines {
 public:
  struct Answer {
    std::vector<std::string> lines;
    std::string why_none;  ///< empty: there are lines
  };
  /// The output of journalctl with these arguments. Called by the reading thread.
  using Read = std::function<Result<std::string>(const std::vector<std::string>& arguments)>;

  /// After that a read that failed is tried again.
  static constexpr Duration retry_interval = std::chrono::minutes{1};

  explicit FailureLines(Read read);
  /// Waits for a read that is under way.
  ~FailureLines();
  FailureLines(const FailureLines&) = delete;
  FailureLines& operator=(const FailureLines&) = delete;

  /// What is known by now; begins to read what is not. Never waits for the journal. Any thread.
  Answer of(const std::vector<std::string>& boots, Time now);

 private:
  void work();

  Read read_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<std::string> wanted_;  // empty: nothing is to be read
  std::vector<std::string> boots_;   // whose lines are in answer_, or are being read
  Answer answer_;
  bool has_failed_ = false;
  Time asked_at_{};
  bool has_to_end_ = false;
  std::thread thread_;  // the last: it uses the others
};

}  // namespace flexrf::helper
