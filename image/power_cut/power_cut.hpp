// What may be on a disk after its power was lost at some point of a log of writes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "image/power_cut/write_log.hpp"

namespace flexrf::power_cut {

/// A disk writes so many bytes whole or not at all, whatever its sector size is said to be.
inline constexpr std::uint64_t tear_size = 512;

/// Bytes of the log that reach the disk.
struct Piece {
  std::uint64_t disk_offset = 0;
  std::uint64_t size = 0;
  std::uint64_t log_offset = 0;
};

/// The pieces in the order in which they are written over the image that was recorded, and what they come to.
struct Remains {
  std::vector<Piece> pieces;
  std::size_t durable = 0;    ///< writes that are on the disk for certain
  std::size_t possible = 0;   ///< writes that may be there or not, with the one that was on its way
  std::size_t kept = 0;       ///< of these, so many are, the torn one too
  std::uint64_t torn_of = 0;  ///< bytes of the torn one; 0: none is kept
  std::uint64_t torn = 0;     ///< so many of them are there
};

/// The power goes when entry `point` is on its way, 0 to the number of entries. Writes before the last flush
/// before it are on the disk, and so are those with FUA. Of the others, and of entry `point` if it writes,
/// any part may be there: which, decides `seed` (none and all of them are tried more often than chance
/// would). Of the last one that is there only some of its pieces of 512 bytes are: its beginning, its end, or
/// any.
Remains remains_after(const WriteLog& log, std::size_t point, std::uint64_t seed);

/// So many different points of a log, ascending, with the first and the last; all if there are no more.
std::vector<std::size_t> chosen_points(const WriteLog& log, std::size_t count, std::uint64_t seed);

}  // namespace flexrf::power_cut
