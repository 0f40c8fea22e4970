#include "image/power_cut/disk_image.hpp"

#include <fcntl.h>
#include <linux/fs.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <system_error>
#include <vector>

namespace flexrf::power_cut {
namespace {

constexpr std::uint64_t buffer_size = std::uint64_t{1} << 20;

Status failure(const char* act, const std::string& path) {
  const int error = errno;
  const char* const hint = error == EEXIST   ? "; it is never written over, remove it first"
                           : error == ENOSPC ? "; make room there"
                                             : "";
  return Status::error(error == ENOENT ? StatusCode::not_found : StatusCode::unavailable,
                       "cannot %s %s: %s%s", act, path.c_str(),
                       std::error_code(error, std::generic_category()).message().c_str(), hint);
}

bool copy_bytes(int from, std::uint64_t from_offset, int to, std::uint64_t to_offset, std::uint64_t size,
                std::vector<char>& buffer) {
  while (size > 0) {
    const ssize_t count = ::pread(from, buffer.data(), static_cast<std::size_t>(std::min(size, buffer_size)),
                                  static_cast<off_t>(from_offset));
    if (count < 0 && errno == EINTR) continue;
    if (count == 0) errno = ENODATA;  // it has become shorter since
    if (count <= 0) return false;
    const auto read = static_cast<std::uint64_t>(count);
    for (std::uint64_t done = 0; done < read;) {
      const ssize_t written = ::pwrite(to, buffer.data() + done, static_cast<std::size_t>(read - done),
                                       static_cast<off_t>(to_offset + done));
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) return false;
      done += static_cast<std::uint64_t>(written);
    }
    from_offset += read;
    to_offset += read;
    size -= read;
  }
  return true;
}

bool copy_image(const OpenFile& base, int to, std::vector<char>& buffer) {
  if (::ioctl(to, FICLONE, base.descriptor()) == 0) return true;
  if (::ftruncate(to, static_cast<off_t>(base.size())) != 0) return false;
  off_t offset = 0;
  while (static_cast<std::uint64_t>(offset) < base.size()) {
    const off_t data = ::lseek(base.descriptor(), offset, SEEK_DATA);
    if (data < 0 && errno == ENXIO) return true;  // a hole up to the end
    if (data < 0) return false;
    const off_t hole = ::lseek(base.descriptor(), data, SEEK_HOLE);
    if (hole < 0) return false;
    if (!copy_bytes(base.descriptor(), static_cast<std::uint64_t>(data), to, static_cast<std::uint64_t>(data),
                    static_cast<std::uint64_t>(hole - data), buffer))
      return false;
    offset = hole;
  }
  return true;
}

}  // namespace

OpenFile::OpenFile(const std::string& path)
    : descriptor_(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC)) {
  struct stat found {};
  if (descriptor_ < 0 || ::fstat(descriptor_, &found) != 0)
    status_ = failure("read", path);
  else if (!S_ISREG(found.st_mode))
    status_ = Status::error(StatusCode::invalid_argument, "%s is no file", path.c_str());
  else
    size_ = static_cast<std::uint64_t>(found.st_size);
}

OpenFile::~OpenFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

Status make_image(const std::string& path, const OpenFile& base, const OpenFile& log,
                  const Remains& remains) {
  const int image = ::open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0644);
  if (image < 0) return failure("make", path);
  std::vector<char> buffer(static_cast<std::size_t>(buffer_size));
  bool is_good = copy_image(base, image, buffer);
  for (const Piece& piece : remains.pieces)
    is_good = is_good &&
              copy_bytes(log.descriptor(), piece.log_offset, image, piece.disk_offset, piece.size, buffer);
  Status status = is_good ? Status{} : failure("write", path);
  if (::close(image) != 0 && status) status = failure("write", path);
  if (!status) ::unlink(path.c_str());
  return status;
}

}  // namespace flexrf::power_cut
