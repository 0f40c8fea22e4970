#include "web-ui/server/access/user_watch.hpp"

#include <sys/stat.h>

#include <utility>

#include "runtime/log/log.hpp"

namespace flexrf::panel {

UserFileWatch::UserFileWatch(std::string file) : file_(std::move(file)), read_(stamp()), seen_(read_) {}

UserFileWatch::Stamp UserFileWatch::stamp() const noexcept {
  struct stat status {};
  if (file_.empty() || ::stat(file_.c_str(), &status) != 0) return {};
  return {status.st_ino, status.st_size, status.st_ctim.tv_sec, status.st_ctim.tv_nsec};
}

std::optional<Users> UserFileWatch::update(Time now) {
  if (file_.empty() || now < next_) return std::nullopt;
  next_ = now + interval;
  const Stamp newest = stamp();
  if (std::exchange(seen_, newest) != newest || newest == read_) return std::nullopt;
  read_ = newest;
  Result<Users> users = read_users(file_);
  if (users) return std::move(*users);
  log_warning("panel", "who may log in stays as it was: {}", users.status().cause());
  return std::nullopt;
}

}  // namespace flexrf::panel
