#include "runtime/parameters/durable_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <system_error>

namespace flexrf {
namespace {

// Closes on the way out; close() reports what it is told.
class Descriptor {
 public:
  explicit Descriptor(int number) noexcept : number_(number) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() { close(); }
  bool close() noexcept {
    const int number = number_;
    number_ = -1;
    return number < 0 || ::close(number) == 0;
  }
  bool is_open() const noexcept { return number_ >= 0; }
  int number() const noexcept { return number_; }

 private:
  int number_;
};

Status failure(const char* act, const std::string& path) {
  const int error = errno;
  const StatusCode code = error == ENOENT                     ? StatusCode::not_found
                          : error == EACCES || error == EPERM ? StatusCode::not_permitted
                                                              : StatusCode::unavailable;
  return Status::error(code, "cannot %s '%s': %s", act, path.c_str(), cause_of(error).c_str());
}

/// A file that nobody else has: what lies there is of a process that was killed while it wrote.
Status write_all(const std::string& path, std::string_view contents, mode_t mode) {
  ::unlink(path.c_str());
  Descriptor file(::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode));
  if (!file.is_open()) return failure("create", path);
  if (::fchmod(file.number(), mode) != 0) return failure("set the permissions of", path);
  while (!contents.empty()) {
    const ssize_t written = ::write(file.number(), contents.data(), contents.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return failure("write", path);
    contents.remove_prefix(static_cast<std::size_t>(written));
  }
  if (::fsync(file.number()) != 0 || !file.close()) return failure("write", path);
  return {};
}

/// Only the directory's own fsync makes a new or removed name outlive a power failure.
Status flush_folder_of(const std::string& path) {
  const std::string folder = folder_of(path);
  const Descriptor directory(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (!directory.is_open() || ::fsync(directory.number()) != 0) return failure("write", folder);
  return {};
}

}  // namespace

const char* name_of_file_kind(mode_t mode) noexcept {
  return S_ISREG(mode)    ? "a file"
         : S_ISDIR(mode)  ? "a folder"
         : S_ISFIFO(mode) ? "a pipe"
         : S_ISSOCK(mode) ? "a socket"
                          : "a device";
}

std::string cause_of(int error) {
  std::string cause = std::error_code(error, std::generic_category()).message();
  if (error == ENOSPC || error == EDQUOT) cause += "; make room there";
  if (error == EROFS) cause += "; mount it for writing, or name a file elsewhere";
  return cause;
}

std::string folder_of(const std::string& path) {
  const std::string parent = std::filesystem::path(path).parent_path().string();
  return parent.empty() ? "." : parent;
}

std::string resolved_path(const std::string& path) {
  std::error_code ignored;
  const std::filesystem::path resolved = std::filesystem::canonical(path, ignored);
  return ignored ? path : resolved.string();
}

Result<std::string> read_file(const std::string& path) {
  // A pipe that nobody writes to would keep open() waiting.
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
  if (!file.is_open()) return failure("read", path);
  struct stat found {};
  if (::fstat(file.number(), &found) != 0) return failure("read", path);
  if (!S_ISREG(found.st_mode))
    return Status::error(StatusCode::invalid_argument, "cannot read '%s': it is %s, not a file", path.c_str(),
                         name_of_file_kind(found.st_mode));
  std::string contents;
  char part[65536];
  while (true) {
    const ssize_t count = ::read(file.number(), part, sizeof(part));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return failure("read", path);
    if (count == 0) return contents;
    contents.append(part, static_cast<std::size_t>(count));
    if (contents.size() > largest_read_file)
      return Status::error(StatusCode::out_of_range, "'%s' has more than 16 MiB", path.c_str());
  }
}

Status replace_file(const std::string& path, std::string_view contents, mode_t fresh_mode,
                    std::size_t largest) {
  if (contents.size() > largest)
    return Status::error(StatusCode::out_of_range,
                         "'%s' would have more than %zu MiB, and could not be read again", path.c_str(),
                         largest >> 20);
  const std::string target = resolved_path(path);
  struct stat former {};
  const mode_t mode = ::stat(target.c_str(), &former) == 0 ? former.st_mode & mode_t{0777} : fresh_mode;
  const std::string fresh = target + ".new";
  if (const Status status = write_all(fresh, contents, mode); !status) {
    ::unlink(fresh.c_str());
    return status;
  }
  if (::rename(fresh.c_str(), target.c_str()) != 0) {
    const Status status = failure("replace", target);
    ::unlink(fresh.c_str());
    return status;
  }
  return flush_folder_of(target);
}

Status remove_file(const std::string& path) {
  if (::unlink(path.c_str()) == 0) return flush_folder_of(path);
  return errno == ENOENT ? Status{} : failure("remove", path);
}

}  // namespace flexrf
