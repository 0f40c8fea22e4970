// What a disk was told, in order: the log of QEMU's blklogwrites, whose format is that of Linux's
// dm-log-writes (Documentation/admin-guide/device-mapper/log-writes.rst).
#pragma once

#include <cstdint>
#include <vector>

#include "base/status.hpp"

namespace flexrf::power_cut {

/// A write, a flush, or both: then the flush is first. A mark is neither.
struct LogEntry {
  std::uint64_t disk_offset = 0;  ///< bytes
  std::uint64_t size = 0;         ///< bytes written; 0: none
  std::uint64_t log_offset = 0;   ///< where in the log the bytes stand
  bool is_flush = false;          ///< all writes before it are on the disk
  bool is_fua = false;            ///< the write is on the disk by itself ("force unit access")
};

struct WriteLog {
  std::uint32_t sector_size = 0;  ///< bytes: what the log counts in
  std::vector<LogEntry> entries;
};

/// Reads the whole log, but not the data, of an open file. `disk_size`: bytes of the disk that was recorded.
/// invalid_argument, naming the entry, for what is no such log, ends early, writes beyond the disk or
/// discards: what a discard leaves on a disk is not known, so a recording is made without (`discard=ignore`,
/// and none from the guest's driver). unavailable: cannot be read.
Result<WriteLog> read_log(int descriptor, std::uint64_t disk_size);

}  // namespace flexrf::power_cut
