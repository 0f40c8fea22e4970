// JpegMaker: pictures of cameras that are only imagined, as JPEGs. Of the library camera_jpeg.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/status.hpp"

namespace flexrf {

/// One thread at a time.
class JpegMaker {
 public:
  JpegMaker() noexcept = default;
  JpegMaker(const JpegMaker&) = delete;
  JpegMaker& operator=(const JpegMaker&) = delete;
  ~JpegMaker();

  /// For pictures of this size, at most 3840x2160. Allocates.
  Status begin(std::uint32_t width, std::uint32_t height);
  /// Where the next one is to be drawn: red, green, blue; rows without gaps.
  std::span<std::uint8_t> canvas() noexcept { return canvas_; }
  /// What is on the canvas, the coarser the less room there is; valid until the next call. Empty: it does not
  /// fit however coarse, or libturbojpeg refuses. It allocates, as
  /// libturbojpeg does with each picture, and is exempt from the guard: no camera of a machine makes its
  /// pictures so.
  std::span<const std::uint8_t> make(std::size_t room) noexcept;

 private:
  void* compressor_ = nullptr;
  int width_ = 0;
  int height_ = 0;
  std::vector<std::uint8_t> canvas_;
  std::vector<std::uint8_t> jpeg_;
};

}  // namespace flexrf
