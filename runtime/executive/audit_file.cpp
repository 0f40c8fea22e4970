#include "runtime/executive/audit_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <utility>

#include "runtime/parameters/durable_file.hpp"

namespace flexrf {
namespace {

/// Of its end, at the start.
constexpr off_t most_read = 256 << 10;

class OpenFile {
 public:
  OpenFile(const std::string& path, int flags) noexcept
      : number_(::open(path.c_str(), flags | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0600)) {}
  ~OpenFile() {
    if (number_ >= 0) ::close(number_);
  }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  bool is_open() const noexcept { return number_ >= 0; }
  int number() const noexcept { return number_; }
  /// Of what is no ordinary file: −1.
  off_t size() const noexcept {
    struct stat status {};
    return ::fstat(number_, &status) == 0 && S_ISREG(status.st_mode) ? status.st_size : -1;
  }

 private:
  int number_;
};

Status failure(const std::string& path, const char* why) {
  return Status::error(StatusCode::unavailable, "--audit %s: %s", path.c_str(), why);
}

Status failure(const std::string& path) {
  return failure(path, cause_of(errno).c_str());
}

}  // namespace

Status AuditFile::check() const {
  if (path_.empty()) return {};
  struct stat status {};
  if (::lstat(path_.c_str(), &status) == 0) {
    if (!S_ISREG(status.st_mode)) return failure(path_, "this is no ordinary file; name one, or `off`");
    if (::access(path_.c_str(), W_OK | R_OK) == 0) return {};
    return Status::error(StatusCode::not_permitted, "%s", failure(path_).cause());
  }
  if (errno != ENOENT && errno != ENOTDIR) return failure(path_);
  const std::size_t slash = path_.rfind('/');
  const std::string folder = slash == std::string::npos ? "." : path_.substr(0, slash + 1);
  if (::stat(folder.c_str(), &status) != 0 || !S_ISDIR(status.st_mode))
    return failure(path_, "there is no such folder; make it, or name a file elsewhere, or `off`");
  if (::access(folder.c_str(), W_OK | X_OK) == 0) return {};
  return Status::error(
      StatusCode::not_permitted,
      "--audit %s: nothing can be written into this folder (%s); name a file elsewhere, or `off`",
      path_.c_str(), strerrordesc_np(errno));
}

std::vector<std::string> AuditFile::last_lines(std::size_t count) const {
  std::vector<std::string> lines;
  if (path_.empty()) return lines;
  const OpenFile file(path_, O_RDONLY);
  const off_t size = file.is_open() ? file.size() : 0;
  if (size <= 0) return lines;
  const off_t begin = size > most_read ? size - most_read : 0;
  std::string text(static_cast<std::size_t>(size - begin), '\0');
  const ssize_t read = ::pread(file.number(), text.data(), text.size(), begin);
  text.resize(read > 0 ? static_cast<std::size_t>(read) : 0);
  std::string_view rest = text;
  if (begin > 0) rest.remove_prefix(std::min(rest.find('\n'), rest.size() - 1) + 1);
  for (std::size_t end = rest.find('\n'); end != std::string_view::npos; end = rest.find('\n')) {
    lines.emplace_back(rest.substr(0, end));
    rest.remove_prefix(end + 1);
  }
  if (lines.size() > count) lines.erase(lines.begin(), lines.end() - static_cast<std::ptrdiff_t>(count));
  return lines;
}

void AuditFile::set_aside() const {
  for (int i = kept; i > 0; --i) {
    const std::string from = i == 1 ? path_ : path_ + "." + std::to_string(i - 1);
    std::rename(from.c_str(), (path_ + "." + std::to_string(i)).c_str());
  }
}

Status AuditFile::append(std::string_view lines) {
  if (path_.empty() || lines.empty()) return {};
  {
    const OpenFile former(path_, O_RDONLY);
    if (former.is_open() && former.size() > 0 &&
        static_cast<std::size_t>(former.size()) + lines.size() > largest)
      set_aside();
  }
  const OpenFile file(path_, O_RDWR | O_APPEND | O_CREAT);
  if (!file.is_open()) return failure(path_);
  const off_t before = file.size();
  if (before < 0) return failure(path_, "this is no ordinary file any more");
  // A line that a power cut has torn must not take the next one along.
  std::string text;
  char last = '\n';
  if (before > 0 && ::pread(file.number(), &last, 1, before - 1) == 1 && last != '\n') text = "\n";
  text += lines;
  const auto undo = [&] {
    const Status status = failure(path_);
    // What is written in part would be read as a whole; where even this fails, the next append mends it.
    if (::ftruncate(file.number(), before) != 0) errno = 0;
    return status;
  };
  std::string_view rest = text;
  while (!rest.empty()) {
    const ssize_t written = ::write(file.number(), rest.data(), rest.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return undo();
    rest.remove_prefix(static_cast<std::size_t>(written));
  }
  // Some disks say only now that they are full.
  return ::fdatasync(file.number()) == 0 ? Status{} : undo();
}

}  // namespace flexrf
