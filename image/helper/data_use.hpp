// Disk usage of the data partition, and removal of archived journal files.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "base/status.hpp"
#include "base/time.hpp"
#include "image/helper/background.hpp"

namespace flexrf::helper {

/// Bytes on the disk. What the file system needs for itself is in `used` and in none of the parts.
struct DataUse {
  std::uint64_t size = 0;
  std::uint64_t used = 0;
  std::uint64_t free = 0;  ///< for the application: the rest is kept for root
  std::uint64_t configuration = 0;
  std::uint64_t audit = 0;
  std::uint64_t journal = 0;
  std::uint64_t old_logs = 0;  ///< of the journal: what remove_old_logs() would remove
  std::uint64_t updates = 0;
  std::uint64_t other = 0;
  bool is_complete = true;  ///< else there are more entries than were counted
};

inline constexpr std::size_t most_data_entries = 20'000;

/// Measures the disk usage below the folder: at most `most_entries` entries, no symbolic links, without
/// folders that cannot be read. Empty: there is no such folder. Blocks. Any thread.
std::optional<DataUse> measure_data(const std::string& folder, std::size_t most_entries = most_data_entries);

/// Whether journald has closed a file of this name: it archived it, or found it damaged.
bool is_old_log(const std::string& name) noexcept;

/// Removes the journal's closed files below the folder. @returns the bytes that they took; not_found: there
/// is none. What is in use stays. Blocks. Any thread.
Result<std::uint64_t> remove_old_logs(const std::string& journal_folder);

/// Measures in a thread of its own, when it is asked, and at most once a minute.
class DataWatch {
 public:
  static constexpr Duration interval = std::chrono::minutes{1};

  explicit DataWatch(std::function<std::optional<DataUse>()> measure);

  /// The latest measurement; empty before the first one, or if the latest failed. Never waits for the disk.
  /// One thread.
  std::optional<DataUse> use(Time now);
  /// The next use() starts a measurement, however recent the latest one is. Any thread.
  void measure_again() noexcept { is_outdated_ = true; }

 private:
  struct Nothing {};

  std::atomic<bool> is_outdated_ = true;
  Time asked_at_{};
  Background<Nothing, std::optional<DataUse>> measuring_;
};

}  // namespace flexrf::helper
