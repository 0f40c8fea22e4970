#include "runtime/realtime/doctor/system_files.hpp"

#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <filesystem>
#include <system_error>

namespace flexrf::doctor {

std::optional<std::string> SystemFiles::text(const std::string& path) const {
  std::FILE* const file = std::fopen(path_of(path).c_str(), "re");
  if (file == nullptr) return std::nullopt;
  std::string contents;
  char buffer[4096];
  std::size_t size = 0;
  while (contents.size() < (1U << 20) && (size = std::fread(buffer, 1, sizeof(buffer), file)) > 0)
    contents.append(buffer, size);
  const bool good = std::ferror(file) == 0;
  std::fclose(file);
  if (!good) return std::nullopt;
  contents.erase(contents.find_last_not_of(" \t\r\n") + 1);
  return contents;
}

std::optional<std::int64_t> SystemFiles::number(const std::string& path) const {
  const auto contents = text(path);
  std::int64_t value = 0;
  if (!contents ||
      std::from_chars(contents->data(), contents->data() + contents->size(), value).ec != std::errc{})
    return std::nullopt;
  return value;
}

std::vector<std::string> SystemFiles::numbered(const std::string& folder, const std::string& prefix) const {
  std::vector<std::pair<long, std::string>> found;
  std::error_code error;
  for (std::filesystem::directory_iterator at(path_of(folder), error), end; !error && at != end;
       at.increment(error)) {
    const std::string name = at->path().filename().string();
    long number = 0;
    const char* const digits = name.data() + std::min(prefix.size(), name.size());
    if (name.starts_with(prefix) &&
        std::from_chars(digits, name.data() + name.size(), number).ptr == name.data() + name.size() &&
        name.size() > prefix.size())
      found.emplace_back(number, name);
  }
  std::sort(found.begin(), found.end());
  std::vector<std::string> names;
  names.reserve(found.size());
  for (auto& [number, name] : found) names.push_back(std::move(name));
  return names;
}

bool SystemFiles::may_write(const std::string& path) const {
  return access(path_of(path).c_str(), W_OK) == 0;
}

}  // namespace flexrf::doctor
