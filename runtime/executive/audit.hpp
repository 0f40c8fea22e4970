// Audit: who did what, and when. Kept in memory for the panel, in a file for later, and said in the log.
#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/executive/audit_file.hpp"
#include "runtime/executive/audit_text.hpp"
#include "runtime/log/log.hpp"
#include "runtime/realtime/thread_setup.hpp"

namespace flexrf {

/// A thread of its own takes what Cell::audit() was told and writes it down. Nobody waits for it: what it
/// cannot take in time is dropped and counted, and where the file cannot be written the cell goes on, the log
/// says so, and what fits into 64 KiB is tried again; how much was more than that stands in the file, too.
/// Changes of one parameter by one person are told as one, once there was none for a second, at least every
/// 10 s; likewise what somebody does again and again.
class Audit {
 public:
  static constexpr std::size_t most_recent = 512;
  static constexpr Duration quiet = std::chrono::seconds{1};
  static constexpr Duration longest_wait = std::chrono::seconds{10};

  /// Nothing is written down in virtual time, where there are no people.
  Audit(Cell& cell, const Options& options);
  Audit(const Audit&) = delete;
  Audit& operator=(const Audit&) = delete;
  /// Waits for the thread: not while is_ending() is true, which only leaving the process ends then.
  ~Audit();

  /// Looks at the file, and at what is in it. The main thread.
  Status prepare();
  Status start() noexcept;
  /// Writes the rest; does not wait. Once.
  void begin_end() noexcept;
  bool is_ending() const noexcept { return thread_.is_started() && !ended_.load(std::memory_order_acquire); }
  /// What of this run the file does not hold; ok: nothing. After is_ending() became false.
  const Status& failure() const noexcept { return failure_; }

  /// What the thread does again and again; tests, and who has no thread. Blocks.
  void turn(Time now);

  struct Stop {
    char who[longest_who] = {};
    std::int64_t at = 0;  ///< ms since 1970
  };
  /// Who has stopped motion, when it is stopped; nothing where nobody said so. Any non-real-time thread.
  std::optional<Stop> stopped_by() const;
  /// Rises when stopped_by() has another answer. Any thread.
  std::uint64_t revision() const noexcept { return revision_.load(std::memory_order_acquire); }

  /// Calls `entry(number, json)` for each of the recent ones whose number is greater than `after`, oldest
  /// first. Those of former runs are as the file has them: perhaps no JSON. Any non-real-time thread.
  /// @returns the number of the last one.
  std::uint64_t visit(std::uint64_t after,
                      const std::function<void(std::uint64_t, std::string_view)>& entry) const;

 private:
  struct Pending {
    AuditEntry entry;
    bool told = false;  // an act, which is told at once; what comes after it is counted
    Time first{};
    Time last{};
  };
  struct OpenHold {
    std::uint64_t number = 0;
    std::string who;
  };

  void run();
  void take(const AuditRecord& record, Time now);
  Pending* find(const AuditRecord& record, std::string_view who);
  void tell_changes(Time now);
  void tell_due(Time now, bool all);
  void tell(const AuditEntry& entry, Time now);
  void write(Time now);
  void keep_what_fits();
  void conclude();
  void note_stop(const AuditRecord& record, std::int64_t at);
  std::string owner_of(const AuditRecord& record);
  static bool is_over(const Pending& pending, Time now, bool all) noexcept;

  Cell& cell_;
  bool on_;
  bool named_;  // the file, by whoever started the cell
  AuditFile file_;
  // ---- the thread's
  std::vector<Pending> pending_;
  std::deque<OpenHold> holds_;
  std::string unwritten_;
  Time retry_at_{};
  std::uint64_t dropped_told_ = 0;
  std::uint64_t lost_ = 0;       // entries that the file could not take, and that were more than fits
  std::uint64_t lost_told_ = 0;  // of them, in the file
  Status told_;                  // of the last attempt
  Status failure_;
  // ---- everybody's
  mutable std::mutex mutex_;
  std::deque<std::string> recent_;
  std::uint64_t last_ = 0;
  std::optional<Stop> stop_;
  std::atomic<std::uint64_t> revision_{1};
  std::atomic<bool> ends_{false};
  std::atomic<bool> ended_{false};
  RunningThread thread_;
};

}  // namespace flexrf
