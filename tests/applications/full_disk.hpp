// A disk that is full, or read-only, for tests of what an application writes while it runs.
#pragma once

#include <string>
#include <vector>

#include "tests/applications/process.hpp"

namespace flexrf::whole {

/// Gives this process mounts of its own, which go with it. Before anything else of this file.
/// @returns empty, or why this machine does not permit it.
std::string prepare_mounts();

/// A file system of 256 KiB in memory, as FOLDER/disk, for whoever is started after it.
class SmallDisk {
 public:
  explicit SmallDisk(const Folder& folder);
  ~SmallDisk();
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;
  std::string operator/(const std::string& name) const { return path_ + "/" + name; }

  /// Not a byte more is taken: nor by these files, whose last blocks are filled by line feeds.
  void fill(const std::vector<std::string>& files = {}) const;
  void make_room() const;
  /// For whoever opens something from now on.
  void make_read_only();
  void make_writable();

 private:
  std::string path_;
  bool is_read_only_ = false;
};

}  // namespace flexrf::whole
