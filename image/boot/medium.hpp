// What the boot choice is written to. Between this and the disk there is nothing that a test's could not lose
// in a power cut.
#pragma once

#include <string>
#include <string_view>

#include "base/status.hpp"

namespace flexrf::boot {

/// Files by their names in one folder. Nothing here is done twice or left out by an implementation: what is
/// called, and in which order, is what a power cut meets. Every call may block.
class Medium {
 public:
  virtual ~Medium() = default;

  /// The file's bytes, of a long one at least its first block_size + 1. not_found if there is none;
  /// invalid_argument if it is none that could be read (a folder, a symbolic link, a pipe); unavailable if it
  /// cannot be.
  virtual Result<std::string> read(const std::string& name) = 0;
  /// Puts these bytes in the place of the file's, over them: it is never emptied first, and keeps its place
  /// on the disk. Made if it was missing; cut behind them if it was longer. It is on the disk only after
  /// flush().
  virtual Status overwrite(const std::string& name, std::string_view bytes) = 0;
  /// Returns when the file's bytes, and its name if it was made, are on the disk.
  virtual Status flush(const std::string& name) = 0;
  /// The same for a partition, or a file, by its path.
  virtual Status flush_device(const std::string& path) = 0;

 protected:
  Medium() = default;
  Medium(const Medium&) = default;
  Medium& operator=(const Medium&) = default;
};

}  // namespace flexrf::boot
