// The medium as it is on a PC: a folder of the ESP.
#pragma once

#include <string>
#include <string_view>

#include "base/status.hpp"
#include "base/time.hpp"
#include "image/boot/medium.hpp"

namespace flexrf::boot {

class FolderMedium final : public Medium {
 public:
  FolderMedium() = default;
  FolderMedium(const FolderMedium&) = delete;
  FolderMedium& operator=(const FolderMedium&) = delete;
  ~FolderMedium() override;

  /// Opens the folder and keeps it from every other process that opens it so, until destruction or the
  /// process's end. busy if another has it for longer than `wait`. Once.
  Status open(const std::string& folder, Duration wait);

  Result<std::string> read(const std::string& name) override;
  Status overwrite(const std::string& name, std::string_view bytes) override;
  Status flush(const std::string& name) override;
  Status flush_device(const std::string& path) override;

 private:
  int folder_ = -1;
  bool has_made_file_ = false;  // and not yet flushed the folder
};

}  // namespace flexrf::boot
