#include "image/boot/folder_medium.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <system_error>
#include <thread>

#include "image/boot/blocks.hpp"

namespace flexrf::boot {
namespace {

class Descriptor {
 public:
  explicit Descriptor(int number) noexcept : number_(number) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  bool is_open() const noexcept { return number_ >= 0; }
  int number() const noexcept { return number_; }

 private:
  int number_;
};

Status failure(const char* act, const std::string& name) {
  const int error = errno;
  if (error == ELOOP)
    return Status::error(StatusCode::invalid_argument, "%s is a symbolic link, not a file", name.c_str());
  const StatusCode code = error == ENOENT                     ? StatusCode::not_found
                          : error == EACCES || error == EPERM ? StatusCode::not_permitted
                                                              : StatusCode::unavailable;
  const char* const hint = error == EROFS || error == EACCES || error == EPERM
                               ? "; it has to be mounted for writing, and this run as root"
                           : error == ENOSPC ? "; make room there"
                                             : "";
  return Status::error(code, "cannot %s %s: %s%s", act, name.c_str(),
                       std::error_code(error, std::generic_category()).message().c_str(), hint);
}

Status must_be_file(int descriptor, const std::string& name, struct stat& found) {
  if (::fstat(descriptor, &found) != 0) return failure("look at", name);
  if (S_ISREG(found.st_mode)) return {};
  return Status::error(StatusCode::invalid_argument, "%s is %s, not a file", name.c_str(),
                       S_ISDIR(found.st_mode) ? "a folder" : "a pipe or a device");
}

// What opens a pipe would wait for its other end, and what follows a link leaves the folder.
constexpr int carefully = O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC;

}  // namespace

FolderMedium::~FolderMedium() {
  if (folder_ >= 0) ::close(folder_);
}

Status FolderMedium::open(const std::string& folder, Duration wait) {
  folder_ = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder_ < 0) return failure("open", folder);
  const Time end = MonotonicClock::now() + wait;
  while (::flock(folder_, LOCK_EX | LOCK_NB) != 0) {
    if (errno != EWOULDBLOCK && errno != EINTR) return failure("lock", folder);
    if (MonotonicClock::now() >= end)
      return Status::error(StatusCode::busy, "another process is changing %s and does not end; try again",
                           folder.c_str());
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return {};
}

Result<std::string> FolderMedium::read(const std::string& name) {
  const Descriptor file(::openat(folder_, name.c_str(), O_RDONLY | carefully));
  if (!file.is_open()) return failure("read", name);
  struct stat found {};
  if (const Status kind = must_be_file(file.number(), name, found); !kind) return kind;
  std::string bytes(block_size + 1, '\0');
  std::size_t size = 0;
  while (size < bytes.size()) {
    const ssize_t count = ::read(file.number(), bytes.data() + size, bytes.size() - size);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return failure("read", name);
    if (count == 0) break;
    size += static_cast<std::size_t>(count);
  }
  bytes.resize(size);
  return bytes;
}

Status FolderMedium::overwrite(const std::string& name, std::string_view bytes) {
  int number = ::openat(folder_, name.c_str(), O_WRONLY | carefully);
  if (number < 0 && errno == ENOENT) {
    number = ::openat(folder_, name.c_str(), O_WRONLY | O_CREAT | O_EXCL | carefully, 0644);
    has_made_file_ = has_made_file_ || number >= 0;
  }
  const Descriptor file(number);
  if (!file.is_open())
    return errno == EISDIR ? Status::error(StatusCode::invalid_argument,
                                           "%s is a folder, not a file; remove it", name.c_str())
                           : failure("write", name);
  struct stat found {};
  if (const Status kind = must_be_file(file.number(), name, found); !kind) return kind;
  std::size_t written = 0;
  while (written < bytes.size()) {
    const ssize_t count =
        ::pwrite(file.number(), bytes.data() + written, bytes.size() - written, static_cast<off_t>(written));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return failure("write", name);
    written += static_cast<std::size_t>(count);
  }
  if (found.st_size > static_cast<off_t>(bytes.size()) &&
      ::ftruncate(file.number(), static_cast<off_t>(bytes.size())) != 0)
    return failure("shorten", name);
  return {};
}

Status FolderMedium::flush(const std::string& name) {
  const Descriptor file(::openat(folder_, name.c_str(), O_RDONLY | carefully));
  if (!file.is_open() || ::fdatasync(file.number()) != 0) return failure("flush", name);
  if (has_made_file_ && ::fsync(folder_) != 0) return failure("flush the folder of", name);
  has_made_file_ = false;
  return {};
}

Status FolderMedium::flush_device(const std::string& path) {
  const Descriptor device(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
  if (!device.is_open()) return failure("open", path);
  struct stat found {};
  if (::fstat(device.number(), &found) != 0) return failure("look at", path);
  if (!S_ISBLK(found.st_mode) && !S_ISREG(found.st_mode))
    return Status::error(StatusCode::invalid_argument, "%s is no partition", path.c_str());
  if (::fsync(device.number()) != 0) return failure("flush", path);
  return {};
}

}  // namespace flexrf::boot
