// CameraEye: looks at a camera's pictures, whichever way they come.
#pragma once

#include "hal/camera/conformance/camera_conformance.hpp"

namespace flexrf {

class CameraEye {
 public:
  /// After the world's start().
  explicit CameraEye(CameraWorld& world) noexcept : world_(world), reader_(world.slot()) {}

  /// The newest picture, if it is another than the last one. From a slot it stays until the next see().
  std::optional<CameraImage> see() noexcept {
    if (world_.slot() == nullptr) return world_.camera().frame();
    const ItemHeader* const header = reader_.newest();
    if (header == nullptr || header->sequence == seen_) return std::nullopt;
    seen_ = header->sequence;
    const auto& frame = *static_cast<const CameraFrame*>(reader_.payload());
    return CameraImage{.data = frame.data().first(frame.size),
                       .width = frame.width,
                       .height = frame.height,
                       .stride = frame.stride,
                       .format = frame.format,
                       .time = Time{Duration{frame.time}},
                       .sequence = frame.sequence};
  }

  /// Cycles until `done`; false: it never was, within half a minute or so.
  template <class Done>
  bool until(const Done& done) {
    for (int cycle = 0; cycle < most_cycles; ++cycle) {
      world_.receive();
      if (done()) return true;
    }
    return false;
  }
  std::optional<CameraImage> next() {
    std::optional<CameraImage> image;
    until([&] { return (image = see()).has_value(); });
    return image;
  }

 private:
  static constexpr int most_cycles = 3000;

  CameraWorld& world_;
  SlotReader reader_;
  std::uint64_t seen_ = 0;
};

/// Of all of its bytes.
inline std::uint64_t checksum(const CameraImage& image) noexcept {
  std::uint64_t sum = 14695981039346656037U;  // FNV-1a
  for (const std::uint8_t byte : image.data) sum = (sum ^ byte) * 1099511628211U;
  return sum;
}

}  // namespace flexrf
