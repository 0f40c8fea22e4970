#include "config-gen/fix/replace_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "config-gen/model/file_contents.hpp"

namespace flexrf::config_gen {
namespace {

namespace fs = std::filesystem;

std::string failure(const std::string& what) {
  return what + ": " + std::strerror(errno);
}

bool write_all(int descriptor, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(descriptor, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    text.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

// What has been written beside the file, until it takes its place.
class Successor {
 public:
  explicit Successor(const fs::path& file)
      : name_((file.parent_path() / ("." + file.filename().string() + ".XXXXXX")).string()),
        descriptor_(::mkostemp(name_.data(), O_CLOEXEC)) {}
  ~Successor() {
    if (descriptor_ < 0) return;
    ::close(descriptor_);
    if (!placed_) ::unlink(name_.c_str());
  }
  Successor(const Successor&) = delete;
  Successor& operator=(const Successor&) = delete;

  std::string fill(const struct stat& as, std::string_view contents) const {
    if (descriptor_ < 0) return failure("no file can be made beside it");
    struct stat own {};
    if (::fstat(descriptor_, &own) != 0) return failure("it cannot be written");
    const bool other_owner = own.st_uid != as.st_uid || own.st_gid != as.st_gid;
    if (other_owner && ::fchown(descriptor_, as.st_uid, as.st_gid) != 0)
      return failure("it is another user's, and would become yours");
    if (!write_all(descriptor_, contents) || ::fchmod(descriptor_, as.st_mode & 07777) != 0 ||
        ::fsync(descriptor_) != 0)
      return failure("it cannot be written");
    return "";
  }

  std::string take_place_of(const fs::path& file) {
    if (::rename(name_.c_str(), file.c_str()) != 0) return failure("it cannot be replaced");
    placed_ = true;
    // The name is on the disk when its folder is. A file system that cannot say so has no better answer.
    const int folder = ::open(file.parent_path().c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (folder >= 0) {
      ::fsync(folder);
      ::close(folder);
    }
    return "";
  }

 private:
  std::string name_;
  int descriptor_;
  bool placed_ = false;
};

// The file that a name leads to, and what it is.
std::string look(const fs::path& file, fs::path& real, struct stat& status) {
  std::error_code error;
  real = fs::canonical(file, error);
  if (error) return "it cannot be found: " + error.message();
  if (::stat(real.c_str(), &status) != 0) return failure("it cannot be found");
  if (!S_ISREG(status.st_mode)) return "it is no file";
  // Also for root, who may write everywhere: somebody has said that it stays as it is.
  if ((status.st_mode & (S_IWUSR | S_IWGRP | S_IWOTH)) == 0) return "it is read-only";
  if (::access(real.c_str(), W_OK) != 0) return failure("it cannot be written");
  if (::access(real.parent_path().c_str(), W_OK | X_OK) != 0) return failure("its folder cannot be written");
  return "";
}

}  // namespace

std::string obstacle_to_replacing(const fs::path& file) {
  fs::path real;
  struct stat status {};
  return look(file, real, status);
}

std::string replace_file(const fs::path& file, std::string_view expected, std::string_view contents) {
  fs::path real;
  struct stat status {};
  if (std::string obstacle = look(file, real, status); !obstacle.empty()) return obstacle;
  Successor successor(real);
  if (std::string obstacle = successor.fill(status, contents); !obstacle.empty()) return obstacle;
  if (contents_of(real) != expected) return "somebody has changed it meanwhile";
  return successor.take_place_of(real);
}

}  // namespace flexrf::config_gen
