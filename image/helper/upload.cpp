#include "image/helper/upload.hpp"

#include <fcntl.h>
#include <sodium.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <utility>

#include "image/helper/update_progress.hpp"
#include "runtime/parameters/durable_file.hpp"

namespace flexrf::helper {
namespace {

// Values of ioprio_set(2). <linux/ioprio.h> defines them too, but some versions of it name a parameter
// `class`, which C++ rejects.
constexpr int of_a_thread = 1;       // IOPRIO_WHO_PROCESS
constexpr int class_none = 0 << 13;  // IOPRIO_CLASS_NONE
constexpr int class_idle = 3 << 13;  // IOPRIO_CLASS_IDLE

/// While it lives, this thread's writes wait for everybody else's: the cell saves, and the journal is
/// written. If the kernel refuses, they are like others'.
class IdleWrites {
 public:
  IdleWrites() noexcept { set(class_idle); }
  ~IdleWrites() { set(class_none); }
  IdleWrites(const IdleWrites&) = delete;
  IdleWrites& operator=(const IdleWrites&) = delete;

 private:
  static void set(int priority) noexcept { syscall(SYS_ioprio_set, of_a_thread, 0, priority); }
};

std::string new_token() {
  std::array<unsigned char, 16> secret{};
  std::array<char, 2 * secret.size() + 1> text{};
  randombytes_buf(secret.data(), secret.size());
  return sodium_bin2hex(text.data(), text.size(), secret.data(), secret.size());
}

std::uint64_t size_of(const std::string& file) {
  struct stat status {};
  return stat(file.c_str(), &status) == 0 ? static_cast<std::uint64_t>(status.st_blocks) * 512 : 0;
}

std::string mebibytes(std::uint64_t bytes) {
  return std::to_string(bytes >> 20) + " MiB";
}

/// errno's.
Answer disk_failure(const std::string& file) {
  const int error = errno;
  const bool is_full = error == ENOSPC || error == EDQUOT;
  return refuse(is_full ? 507 : 503, "the bundle cannot be written to " + file + ": " + cause_of(error) +
                                         "; the upload is gone, begin anew");
}

}  // namespace

Upload::Upload(const UpdateFiles& files, FreeBytes free_bytes)
    : files_(files), free_bytes_(std::move(free_bytes)), part_path_(bundle_of(files) + ".part") {
  unlink(part_path_.c_str());
}

Upload::~Upload() {
  close_file();
}

Answer Upload::begin(std::uint64_t size, Time now) {
  if (size == 0) return refuse(400, "'size' is 0; it is the bundle's size in bytes");
  if (size > largest)
    return refuse(413, "a bundle has at most " + mebibytes(largest) + "; this is no bundle");
  // What is replaced makes room.
  const std::uint64_t room = free_bytes_(files_.folder) + size_of(part_path_) + size_of(bundle_of(files_));
  if (room < size + spare)
    return refuse(507, "there is no room for " + std::to_string(size) + " bytes: " + mebibytes(room) +
                           " are free, of which " + mebibytes(spare) +
                           " stay so; make room on the data partition");
  drop();
  if (unlink(bundle_of(files_).c_str()) != 0 && errno != ENOENT) return disk_failure(bundle_of(files_));
  file_ = open(part_path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0600);
  if (file_ < 0) return disk_failure(part_path_);
  token_ = new_token();
  size_ = size;
  received_ = on_disk_ = 0;
  heard_of_ = now;
  publish();
  Answer answer;
  answer.upload = token_;
  return answer;
}

Answer Upload::part(std::string_view token, std::uint64_t offset, std::string_view bytes, Time now) {
  if (!is_token(token))
    return refuse(
        404, "there is no such upload: it was replaced, or given up after 10 min without a part; begin anew");
  Answer answer;
  if (file_ < 0 || offset != received_) {
    answer = refuse(409, file_ < 0 ? "all of the bundle is here already"
                                   : "the next part begins at byte " + std::to_string(received_));
    answer.received = received_;
    return answer;
  }
  if (bytes.size() > size_ - received_)
    return refuse(413, "the part goes beyond the bundle's " + std::to_string(size_) +
                           " bytes; upload again with the right size");
  heard_of_ = now;
  answer = write(bytes);
  if (!answer.is_done()) drop();
  publish();
  if (answer.is_done()) answer.received = received_;
  return answer;
}

Answer Upload::write(std::string_view bytes) {
  const IdleWrites idle;
  while (!bytes.empty()) {
    const ssize_t count = ::write(file_, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return disk_failure(part_path_);
    bytes.remove_prefix(static_cast<std::size_t>(count));
    received_ += static_cast<std::uint64_t>(count);
  }
  const bool is_last = received_ == size_;
  if (!is_last && received_ - on_disk_ < written_through_each) return {};
  if ((is_last ? fsync(file_) : fdatasync(file_)) != 0) return disk_failure(part_path_);
  on_disk_ = received_;
  return {};
}

std::string Upload::finish() {
  close_file();
  publish();
  if (rename(part_path_.c_str(), bundle_of(files_).c_str()) == 0) return {};
  const std::string why = disk_failure(bundle_of(files_)).why;
  drop();
  return why;
}

bool Upload::remove_abandoned(Time now) {
  if (file_ < 0 || now - heard_of_ < patience) return false;
  drop();
  return true;
}

Upload::Received Upload::received() const {
  const std::lock_guard lock(reading_);
  return published_;
}

bool Upload::is_token(std::string_view token) const noexcept {
  return !token_.empty() && token.size() == token_.size() &&
         sodium_memcmp(token.data(), token_.data(), token_.size()) == 0;
}

void Upload::close_file() {
  if (file_ >= 0) close(file_);
  file_ = -1;
}

void Upload::drop() {
  close_file();
  unlink(part_path_.c_str());
  token_.clear();
  size_ = received_ = 0;
  publish();
}

void Upload::publish() {
  const std::lock_guard lock(reading_);
  published_ = {file_ >= 0, received_, size_};
}

}  // namespace flexrf::helper
