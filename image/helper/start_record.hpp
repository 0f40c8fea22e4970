// Files on /data that tell why a version did not come up: each start of a slot leaves a record, and the
// version that runs after a fallback keeps the last one of the slot that failed.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/status.hpp"
#include "image/boot/choice.hpp"
#include "image/helper/files.hpp"
#include "image/helper/permission.hpp"

namespace flexrf::helper {

/// The last start of a slot that has not come up.
struct StartRecord {
  std::uint64_t trial = 0;  ///< the choice's trial for which GRUB counted the start
  unsigned start = 0;       ///< its number in that trial, 1 to 3; 0: no start was recorded
  std::uint64_t began = 0;  ///< seconds since 1970 by the PC's clock
  std::string reason;       ///< why the version had not come up, one line of at most 400 bytes
  bool has_given_up = false;
  /// The journal's identifiers of the boots of this trial in which the slot ran, 32 hexadecimal digits each,
  /// the oldest first; 3 at most.
  std::vector<std::string> boots;

  friend bool operator==(const StartRecord&, const StartRecord&) = default;
};

/// A version from which GRUB fell back.
struct Failure {
  boot::Slot slot = boot::Slot::a;
  std::string version;        ///< empty: unknown
  std::uint64_t trial = 0;    ///< that failed
  unsigned starts = 0;        ///< that GRUB counted, 0 to 3
  bool is_dismissed = false;  ///< an admin has seen it
  StartRecord last;           ///< of the last start that left a record
};

inline constexpr std::size_t most_boots = 3;
inline constexpr std::size_t longest_start_reason = 400;

/// /data/update/last-start-a or -b.
std::string start_record_file(const UpdateFiles& files, boot::Slot slot);
/// /data/update/last-failure-a or -b.
std::string failure_file(const UpdateFiles& files, boot::Slot slot);

/// An empty record where the file is missing or unreadable. Blocks. Any thread.
StartRecord read_start_record(const UpdateFiles& files, boot::Slot slot);
/// Durable when it returns. Blocks. One thread.
Status write_start_record(const UpdateFiles& files, boot::Slot slot, const StartRecord& record);
/// Empty: none is kept. Blocks. Any thread.
std::optional<Failure> read_failure(const UpdateFiles& files, boot::Slot slot);
/// Durable when it returns. Blocks. One thread at a time.
Status write_failure(const UpdateFiles& files, const Failure& failure);

/// For a person, in one sentence without a full stop.
std::string reason_of(const Failure& failure);

/// The failure to show: none that was dismissed, and none of a version that its slot no longer holds. Blocks.
/// Any thread.
std::optional<Failure> failure_to_show(const UpdateFiles& files, const Facts& facts);

}  // namespace flexrf::helper
