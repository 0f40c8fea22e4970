#include "image/power_cut/write_log.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <bit>
#include <cerrno>
#include <cstddef>
#include <system_error>

namespace flexrf::power_cut {
namespace {

constexpr std::uint64_t magic_number = 0x6a736677736872;
constexpr std::uint64_t known_version = 1;
constexpr std::uint32_t least_sector_size = 512;
constexpr std::uint32_t largest_sector_size = std::uint32_t{1} << 23;

constexpr std::uint64_t flush_flag = 1;
constexpr std::uint64_t fua_flag = 2;
constexpr std::uint64_t discard_flag = 4;
constexpr std::uint64_t mark_flag = 8;
constexpr std::uint64_t metadata_flag = 16;
constexpr std::uint64_t known_flags = flush_flag | fua_flag | discard_flag | mark_flag | metadata_flag;

// Both what the log begins with and an entry are 32 bytes at most.
using Head = std::array<unsigned char, 32>;

std::uint64_t little_endian(const Head& head, std::size_t offset, std::size_t size) noexcept {
  std::uint64_t number = 0;
  for (std::size_t i = size; i > 0; --i) number = number << 8 | head[offset + i - 1];
  return number;
}

Status read_head(int descriptor, std::uint64_t offset, Head& head) {
  std::size_t size = 0;
  while (size < head.size()) {
    const ssize_t count =
        ::pread(descriptor, head.data() + size, head.size() - size, static_cast<off_t>(offset + size));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0)
      return Status::error(StatusCode::unavailable, "the log cannot be read: %s",
                           std::error_code(errno, std::generic_category()).message().c_str());
    if (count == 0) return Status::error(StatusCode::invalid_argument, "the log ends early");
    size += static_cast<std::size_t>(count);
  }
  return {};
}

Status refusal(std::uint64_t entry, const char* what) {
  return Status::error(StatusCode::invalid_argument, "entry %llu of the log %s",
                       static_cast<unsigned long long>(entry), what);
}

// Reads entries one after the other.
class Reader {
 public:
  Reader(int descriptor, std::uint64_t log_size, std::uint64_t disk_size, std::uint32_t sector_size) noexcept
      : descriptor_(descriptor),
        log_size_(log_size),
        disk_size_(disk_size),
        sector_size_(sector_size),
        offset_(sector_size) {}

  Status next(std::uint64_t number, std::uint64_t count, LogEntry& entry) {
    if (log_size_ < offset_ || log_size_ - offset_ < sector_size_) return ends_early(number, count);
    Head head{};
    if (const Status read = read_head(descriptor_, offset_, head); !read) return read;
    offset_ += sector_size_;
    const std::uint64_t sector = little_endian(head, 0, 8);
    const std::uint64_t sectors = little_endian(head, 8, 8);
    const std::uint64_t flags = little_endian(head, 16, 8);
    const std::uint64_t data_size = little_endian(head, 24, 8);
    if ((flags & ~known_flags) != 0) return refusal(number, "has flags that are not known");
    if ((flags & discard_flag) != 0)
      return refusal(number,
                     "is a discard, and what that leaves on a disk is not known; record with discard=ignore");
    if ((flags & mark_flag) != 0) {
      if (sectors != 0) return refusal(number, "is a mark that writes");
      return {};
    }
    if (sectors > (log_size_ - offset_) / sector_size_) return ends_early(number, count);
    const std::uint64_t disk_sectors = disk_size_ / sector_size_;
    if (sectors > 0 && (sector > disk_sectors || sectors > disk_sectors - sector))
      return refusal(number, "writes beyond the end of the disk; is this the image that was recorded?");
    const std::uint64_t size = sectors * sector_size_;
    if (data_size != 0 && data_size != size)
      return refusal(number, "has data of another length than it writes");
    if (size == 0 && (flags & flush_flag) == 0) return refusal(number, "neither writes nor flushes");
    entry = {size > 0 ? sector * sector_size_ : 0, size, offset_, (flags & flush_flag) != 0,
             (flags & fua_flag) != 0};
    offset_ += size;
    return {};
  }

 private:
  static Status ends_early(std::uint64_t number, std::uint64_t count) {
    return Status::error(StatusCode::invalid_argument, "the log ends within entry %llu of %llu",
                         static_cast<unsigned long long>(number), static_cast<unsigned long long>(count));
  }

  int descriptor_;
  std::uint64_t log_size_;
  std::uint64_t disk_size_;
  std::uint64_t sector_size_;
  std::uint64_t offset_;
};

}  // namespace

Result<WriteLog> read_log(int descriptor, std::uint64_t disk_size) {
  struct stat found {};
  if (::fstat(descriptor, &found) != 0 || !S_ISREG(found.st_mode))
    return Status::error(StatusCode::invalid_argument, "the log is no file");
  const auto log_size = static_cast<std::uint64_t>(found.st_size);
  Head head{};
  if (const Status read = read_head(descriptor, 0, head); !read) return read;
  if (little_endian(head, 0, 8) != magic_number)
    return Status::error(StatusCode::invalid_argument, "this is no log of writes: it does not begin as one");
  const std::uint64_t version = little_endian(head, 8, 8);
  if (version != known_version)
    return Status::error(StatusCode::invalid_argument, "the log has version %llu, and only 1 is known",
                         static_cast<unsigned long long>(version));
  const std::uint64_t count = little_endian(head, 16, 8);
  WriteLog log;
  log.sector_size = static_cast<std::uint32_t>(little_endian(head, 24, 4));
  if (!std::has_single_bit(log.sector_size) || log.sector_size < least_sector_size ||
      log.sector_size > largest_sector_size)
    return Status::error(StatusCode::invalid_argument,
                         "the log's sectors have %u bytes; a power of two from 512 is expected",
                         log.sector_size);
  Reader reader(descriptor, log_size, disk_size, log.sector_size);
  for (std::uint64_t number = 0; number < count; ++number) {
    LogEntry entry;
    if (const Status read = reader.next(number, count, entry); !read) return read;
    log.entries.push_back(entry);
  }
  return log;
}

}  // namespace flexrf::power_cut
