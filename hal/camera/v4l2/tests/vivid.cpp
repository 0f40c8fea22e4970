#include "hal/camera/v4l2/tests/vivid.hpp"

#include <fcntl.h>
#include <linux/videodev2.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cstring>

namespace flexrf {

Vivid::~Vivid() {
  let_go();
  plug_in();
}

bool Vivid::open() {
  if (descriptor_ < 0) descriptor_ = ::open(path, O_RDWR | O_NONBLOCK | O_CLOEXEC);
  return descriptor_ >= 0;
}

bool Vivid::set(const char* control, std::int32_t value) {
  if (!open()) return false;
  v4l2_query_ext_ctrl found{};
  for (found.id = V4L2_CTRL_FLAG_NEXT_CTRL; ioctl(descriptor_, VIDIOC_QUERY_EXT_CTRL, &found) == 0;
       found.id |= V4L2_CTRL_FLAG_NEXT_CTRL) {
    if (std::strcmp(found.name, control) != 0) continue;
    v4l2_control wanted{};
    wanted.id = found.id;
    wanted.value = value;
    return ioctl(descriptor_, VIDIOC_S_CTRL, &wanted) == 0;
  }
  return false;
}

bool Vivid::choose_input(int input) {
  return open() && ioctl(descriptor_, VIDIOC_S_INPUT, &input) == 0;
}

void Vivid::plug_in() {
  if (descriptor_ >= 0) ::close(descriptor_);
  descriptor_ = -1;
}

bool Vivid::occupy() {
  occupier_ = ::open(path, O_RDWR | O_NONBLOCK | O_CLOEXEC);
  v4l2_requestbuffers buffers{};
  buffers.count = 2;
  buffers.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  buffers.memory = V4L2_MEMORY_MMAP;
  return occupier_ >= 0 && ioctl(occupier_, VIDIOC_REQBUFS, &buffers) == 0;
}

void Vivid::let_go() {
  if (occupier_ >= 0) ::close(occupier_);
  occupier_ = -1;
}

void Vivid::restore() {
  choose_input(0);
  set("Percentage of Dropped Buffers", 0);
  set("Brightness", 128);
}

}  // namespace flexrf
