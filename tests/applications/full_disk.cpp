#include "tests/applications/full_disk.hpp"

#include <fcntl.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "runtime/executive/tests/checks.hpp"

namespace flexrf::whole {
namespace {

void append_until_full(const std::string& path, const std::string& block) {
  const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600);
  CHECK(file >= 0);
  while (write(file, block.data(), block.size()) > 0) {
  }
  const int cause = errno;
  close(file);
  CHECK_EQUAL(cause, ENOSPC);
}

}  // namespace

std::string prepare_mounts() {
  if (unshare(CLONE_NEWNS) != 0) return std::string{"unshare: "} + strerrordesc_np(errno);
  if (mount(nullptr, "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0)
    return std::string{"mount: "} + strerrordesc_np(errno);
  const Folder folder;
  if (mount("tmpfs", folder.path().c_str(), "tmpfs", 0, "size=64k") != 0)
    return std::string{"mount: "} + strerrordesc_np(errno);
  umount2(folder.path().c_str(), MNT_DETACH);
  return {};
}

SmallDisk::SmallDisk(const Folder& folder) : path_(folder / "disk") {
  CHECK(mkdir(path_.c_str(), 0700) == 0);
  CHECK(mount("tmpfs", path_.c_str(), "tmpfs", 0, "size=256k,mode=0700") == 0);
}

SmallDisk::~SmallDisk() {
  if (is_read_only_) umount2(path_.c_str(), MNT_DETACH);
  umount2(path_.c_str(), MNT_DETACH);
}

void SmallDisk::fill(const std::vector<std::string>& files) const {
  append_until_full(*this / "ballast", std::string(4096, '.'));
  for (const std::string& file : files) append_until_full(*this / file, "\n");
}

void SmallDisk::make_room() const {
  CHECK(unlink((*this / "ballast").c_str()) == 0);
}

void SmallDisk::make_read_only() {
  // A mount over it, for files that are open for writing forbid to change the one that is there.
  const char* const path = path_.c_str();
  CHECK(mount(path, path, nullptr, MS_BIND, nullptr) == 0);
  is_read_only_ = true;
  CHECK(mount(nullptr, path, nullptr, MS_REMOUNT | MS_BIND | MS_RDONLY, nullptr) == 0);
}

void SmallDisk::make_writable() {
  CHECK(umount2(path_.c_str(), MNT_DETACH) == 0);
  is_read_only_ = false;
}

}  // namespace flexrf::whole
