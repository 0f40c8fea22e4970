// What fills the partition for data, and removing old logs from it.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "base/status.hpp"
#include "base/time.hpp"

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

/// Counts at most so many entries below the folder, follows no symbolic link and leaves out what cannot be
/// read. Empty: there is no such folder. Blocks. Any thread.
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
  /// Waits for a measurement that is under way.
  ~DataWatch();
  DataWatch(const DataWatch&) = delete;
  DataWatch& operator=(const DataWatch&) = delete;

  /// As it was measured last; empty: not yet, or it cannot be measured. Never waits for the disk. Any thread.
  std::optional<DataUse> use(Time now);
  /// The next use() measures, whenever the last one did. Any thread.
  void measure_again();

 private:
  void work();

  std::function<std::optional<DataUse>()> measure_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<Time> asked_at_;
  bool is_wanted_ = false;
  bool has_to_end_ = false;
  std::optional<DataUse> use_;
  std::thread thread_;  // the last: it uses the others
};

}  // namespace flexrf::helper
