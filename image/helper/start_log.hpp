// Keeps the record of the start that is under way, and of the one from which GRUB fell back.
#pragma once

#include <optional>
#include <string>

#include "base/time.hpp"
#include "image/helper/files.hpp"
#include "image/helper/permission.hpp"
#include "image/helper/start_record.hpp"
#include "image/helper/surroundings.hpp"

namespace flexrf::helper {

/// One thread. A helper that was restarted continues the record of the same boot.
class StartLog {
 public:
  /// A reason that changes faster is not written each time: the disk wears.
  static constexpr Duration between_writes = std::chrono::seconds{10};

  /// Both references outlive it.
  StartLog(const Files& files, const Surroundings& surroundings)
      : files_(files), surroundings_(surroundings) {}

  /// The version that runs has not come up. The first call in a boot writes a record with this reason, one
  /// line; later ones do nothing. Ignored, as the next two are, unless GRUB counted this start. Blocks while
  /// it writes.
  void begin(const Facts& facts, const std::string& reason, Time now);
  /// Why the version has not come up, one line.
  void note(const Facts& facts, const std::string& reason, Time now);
  /// The helper restarts the PC for this reason. It stays the reason of this start.
  void give_up(const Facts& facts, const std::string& reason, Time now);
  /// The version that runs has come up. Called before the mark that says so is written, so that a power cut
  /// in between leaves no record to blame a later start for.
  void clear(const Facts& facts);
  /// GRUB fell back from the other slot: its last record becomes the failure that the page shows.
  void keep_failure(const Facts& facts);

 private:
  static StartRecord new_record(const Facts& facts, const std::string& boot, const StartRecord& before);
  void write(const Facts& facts, Time now);
  void say(const Status& failure);

  const Files& files_;
  const Surroundings& surroundings_;
  std::optional<StartRecord> record_;  // of this boot
  std::optional<Time> written_at_;
  std::string written_reason_;
  std::string said_;  // of failures, so that one is said once
};

}  // namespace flexrf::helper
