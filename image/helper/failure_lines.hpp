// The last lines that the application's unit left in the journal in some boots.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "base/status.hpp"
#include "base/time.hpp"
#include "image/helper/background.hpp"

namespace flexrf::helper {

inline constexpr std::size_t most_journal_lines = 20;
inline constexpr std::size_t longest_journal_line = 200;
inline constexpr std::size_t most_journal_bytes = 4096;

/// Arguments of journalctl for the lines of flexrf.service, and of systemd about it, in these boots. Each
/// line has the seconds since its kernel started.
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

  /// Time from a failed read to the next try.
  static constexpr Duration retry_interval = std::chrono::minutes{1};

  explicit FailureLines(Read read);

  /// The lines of these boots. Starts to read them if that was not done, and says so; never waits for the
  /// journal. One thread.
  Answer of(const std::vector<std::string>& boots, Time now);

 private:
  using Boots = std::vector<std::string>;
  using Lines = Result<std::vector<std::string>>;

  Boots boots_;               // of the latest question
  std::uint64_t number_ = 0;  // of the latest question
  Time asked_at_{};
  Background<Boots, Lines> reading_;
};

}  // namespace flexrf::helper
