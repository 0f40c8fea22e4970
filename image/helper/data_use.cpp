#include "image/helper/data_use.hpp"

#include <sys/stat.h>
#include <sys/statvfs.h>

#include <filesystem>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace flexrf::helper {
namespace {

namespace fs = std::filesystem;

/// Disk space of the file, bytes; 0 if it no longer exists.
std::uint64_t bytes_of(const fs::path& file) {
  struct stat found {};
  constexpr std::uint64_t block = 512;  // whatever the file system's are
  return lstat(file.c_str(), &found) == 0 ? static_cast<std::uint64_t>(found.st_blocks) * block : 0;
}

/// `place`: the names below the folder, as "flexrf/audit.1".
std::uint64_t& part_of(DataUse& use, std::string_view place) {
  if (place.starts_with("flexrf/audit")) return use.audit;
  if (place.starts_with("flexrf/config")) return use.configuration;
  if (place == "journal" || place.starts_with("journal/")) return use.journal;
  if (place == "update" || place.starts_with("update/")) return use.updates;
  return use.other;
}

}  // namespace

std::optional<DataUse> measure_data(const std::string& folder, std::size_t most_entries) {
  struct statvfs status {};
  if (statvfs(folder.c_str(), &status) != 0) return std::nullopt;
  DataUse use;
  use.size = static_cast<std::uint64_t>(status.f_blocks) * status.f_frsize;
  use.used = static_cast<std::uint64_t>(status.f_blocks - status.f_bfree) * status.f_frsize;
  use.free = static_cast<std::uint64_t>(status.f_bavail) * status.f_frsize;
  std::size_t entries = 0;
  std::error_code error;
  const auto options = fs::directory_options::skip_permission_denied;
  for (fs::recursive_directory_iterator entry(folder, options, error), end; !error && entry != end;
       entry.increment(error)) {
    if (++entries > most_entries) {
      use.is_complete = false;
      break;
    }
    const std::string place = entry->path().string().substr(folder.size() + 1);
    const std::uint64_t bytes = bytes_of(entry->path());
    part_of(use, place) += bytes;
    if (place.starts_with("journal/") && is_old_log(entry->path().filename().string())) use.old_logs += bytes;
  }
  // A folder that went away meanwhile ends the loop.
  if (error) use.is_complete = false;
  return use;
}

bool is_old_log(const std::string& name) noexcept {
  return name.ends_with(".journal~") || (name.ends_with(".journal") && name.find('@') != std::string::npos);
}

Result<std::uint64_t> remove_old_logs(const std::string& journal_folder) {
  std::vector<fs::path> old_logs;
  std::error_code error;
  for (fs::recursive_directory_iterator entry(journal_folder, error), end; !error && entry != end;
       entry.increment(error)) {
    std::error_code ignored;
    if (entry->symlink_status(ignored).type() == fs::file_type::regular &&
        is_old_log(entry->path().filename().string()))
      old_logs.push_back(entry->path());
  }
  if (error)
    return Status::error(StatusCode::unavailable, "cannot read %s: %s", journal_folder.c_str(),
                         error.message().c_str());
  if (old_logs.empty()) return Status::error(StatusCode::not_found, "there are no old logs to remove");
  std::uint64_t bytes = 0;
  for (const fs::path& file : old_logs) {
    const std::uint64_t of_file = bytes_of(file);
    fs::remove(file, error);
    if (error)
      return Status::error(StatusCode::unavailable, "cannot remove %s: %s", file.c_str(),
                           error.message().c_str());
    bytes += of_file;
  }
  return bytes;
}

DataWatch::DataWatch(std::function<std::optional<DataUse>()> measure)
    : measuring_([measure = std::move(measure)](const Nothing&) { return measure(); }) {}

std::optional<DataUse> DataWatch::use(Time now) {
  if (is_outdated_.exchange(false) || now - asked_at_ >= interval) {
    asked_at_ = now;
    measuring_.ask({});
  }
  const auto found = measuring_.found();
  return found ? found->value : std::nullopt;
}

}  // namespace flexrf::helper
