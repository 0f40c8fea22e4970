#include "runtime/executive/motion_permit.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <string_view>

#include "runtime/log/log.hpp"
#include "runtime/parameters/durable_file.hpp"

namespace flexrf {
namespace {

constexpr std::string_view permitted = "permitted";

Status refused(std::string_view reason) noexcept {
  return Status::error(StatusCode::not_permitted, "this machine does not permit motion: %.*s",
                       static_cast<int>(reason.size()), reason.data());
}

Status unreadable(const std::string& file, int error) noexcept {
  return Status::error(StatusCode::not_permitted, "this machine has not permitted motion: %s: %s",
                       file.c_str(), cause_of(error).c_str());
}

/// It goes into logs, pages and terminals.
char printable(char one) noexcept {
  return one >= ' ' && one <= '~' ? one : '?';
}

Status read_word(const std::string& file) noexcept {
  // A pipe without a writer would keep whoever opens it.
  const int descriptor = open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor < 0) return unreadable(file, errno);
  struct stat about {};
  std::array<char, 160> text{};
  ssize_t length = -1;
  int error = EINVAL;  // no regular file
  if (fstat(descriptor, &about) == 0 && S_ISREG(about.st_mode)) {
    length = read(descriptor, text.data(), text.size());
    error = errno;
  }
  close(descriptor);
  if (length < 0) return unreadable(file, error);
  std::string_view line{text.data(), static_cast<std::size_t>(length)};
  line = line.substr(0, line.find('\n'));
  if (line == permitted) return {};
  if (line.empty()) return refused(file + " is empty");
  std::transform(line.begin(), line.end(), text.begin(), printable);
  return refused(line);
}

}  // namespace

void MotionPermit::observe(Time now) noexcept {
  const bool is_first = looked_at_ == Time{};
  if (file_.empty() || (!is_first && now - looked_at_ < interval)) return;
  looked_at_ = now;
  const Status word = read_word(file_);
  if (std::strcmp(word.cause(), word_.cause()) == 0) return;
  word_ = word;
  if (word) {
    control_->permit_motion();
    log_info(application_, "this machine permits motion; what moves waits for Start");
  } else {
    control_->forbid_motion(word);
    log_warning(application_, "{}", word.cause());
  }
}

}  // namespace flexrf
