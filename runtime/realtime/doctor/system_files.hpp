// The files in which the kernel tells about the machine, below a root that tests replace.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace flexrf::doctor {

class SystemFiles {
 public:
  /// `root` stands for "/"; "" is the machine itself.
  explicit SystemFiles(std::string root) : root_(std::move(root)) {}

  /// Contents without the blank end; nothing when it cannot be read. At most 1 MiB.
  std::optional<std::string> text(const std::string& path) const;
  std::optional<std::int64_t> number(const std::string& path) const;
  /// Names in a folder that begin with `prefix` and go on with a digit, ordered by that number.
  std::vector<std::string> numbered(const std::string& folder, const std::string& prefix) const;
  bool may_write(const std::string& path) const;
  std::string path_of(const std::string& path) const { return root_ + path; }

 private:
  std::string root_;
};

}  // namespace flexrf::doctor
