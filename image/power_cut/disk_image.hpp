// Images of disks as files.
#pragma once

#include <cstdint>
#include <string>

#include "base/status.hpp"
#include "image/power_cut/power_cut.hpp"

namespace flexrf::power_cut {

/// A file that is open for reading, until destruction.
class OpenFile {
 public:
  explicit OpenFile(const std::string& path);
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
  ~OpenFile();

  /// Why it is not open; a file that is none counts as one that cannot be opened.
  const Status& status() const noexcept { return status_; }
  int descriptor() const noexcept { return descriptor_; }
  std::uint64_t size() const noexcept { return size_; }

 private:
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
  Status status_;
};

/// Makes the file `path`, which must not be there: a copy of `base` (on file systems that can, one that
/// shares its blocks; holes stay holes) with the pieces of `log` written over it. On failure there is no such
/// file.
Status make_image(const std::string& path, const OpenFile& base, const OpenFile& log, const Remains& remains);

}  // namespace flexrf::power_cut
