#pragma once

#include <algorithm>

#include "finder_unit.hpp"

namespace flexrf::user {

class Finder final : public FinderUnit {
 public:
  void step(const Tick& /*tick*/) override {
    const View<CameraFrame> picture = pictures.latest();
    if (feedback.sees && !picture) ++feedback.blind;
    feedback.sees = static_cast<bool>(picture);
    if (!picture || !picture.is_new() || picture->format != PixelFormat::rgb24) return;
    ++feedback.pictures;
    if (sequence_ != 0) feedback.gaps += picture->sequence - sequence_ - 1;
    sequence_ = picture->sequence;
    look(*picture);
  }

 private:
  /// In the row in the middle.
  void look(const CameraFrame& frame) {
    const std::uint8_t* pixel = frame.data().data() + std::size_t{frame.height / 2} * frame.stride;
    std::uint64_t sum = 0;
    std::uint64_t count = 0;
    for (std::uint32_t x = 0; x < frame.width; ++x, pixel += 3) {
      if (pixel[0] <= pixel[1] + 100 || pixel[0] <= pixel[2] + 100) continue;
      sum += x;
      ++count;
    }
    if (count == 0) return;
    ++feedback.found;
    feedback.place = static_cast<double>(sum) / static_cast<double>(count) / frame.width;
    feedback.greatest_place = std::max(feedback.greatest_place, feedback.place);
  }

  std::uint64_t sequence_ = 0;
};

}  // namespace flexrf::user
