// Vivid: the far side of the kernel's virtual camera: what makes it lose pictures, fail and go away.
#pragma once

#include <cstdint>

namespace flexrf {

class Vivid {
 public:
  static constexpr const char* path = "/dev/video0";
  /// The same, whose buffers are described by planes.
  static constexpr const char* path_with_planes = "/dev/video1";
  static constexpr const char* name = "vivid-000-vid-cap";  // in /sys/class/video4linux

  Vivid() = default;
  Vivid(const Vivid&) = delete;
  Vivid& operator=(const Vivid&) = delete;
  ~Vivid();

  /// By the name that the kernel shows. False: it is not there, or was refused.
  bool set(const char* control, std::int32_t value);
  /// Its inputs: a webcam, television, S-Video, HDMI. Television is interlaced, 720x576.
  bool choose_input(int input);
  /// Gone until nobody has it open any more, this one included: plug_in() lets go of it.
  bool unplug() { return set("Disconnect", 1); }
  void plug_in();
  /// Streams from it as another program does, as far as having its buffers.
  bool occupy();
  void let_go();
  /// As it was when the kernel began.
  void restore();

 private:
  bool open();

  int descriptor_ = -1;
  int occupier_ = -1;
};

}  // namespace flexrf
