#include "web-ui/server/access/file_watch.hpp"

#include <sys/stat.h>

#include <utility>

namespace flexrf::panel {

FileWatch::FileWatch(std::string file) : file_(std::move(file)), told_(stamp()), seen_(told_) {}

FileWatch::Stamp FileWatch::stamp() const noexcept {
  struct stat status {};
  if (file_.empty() || ::stat(file_.c_str(), &status) != 0) return {};
  return {status.st_ino, status.st_size, status.st_ctim.tv_sec, status.st_ctim.tv_nsec};
}

bool FileWatch::has_changed(Time now) {
  if (file_.empty() || now < next_) return false;
  next_ = now + interval;
  const Stamp newest = stamp();
  if (std::exchange(seen_, newest) != newest || newest == told_) return false;
  told_ = newest;
  return true;
}

}  // namespace flexrf::panel
