// One picture of an image type, scaled down and encoded as JPEG.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "runtime/core/type_descriptor.hpp"

namespace flexrf::panel {

/// Where the fields of an image type lie: width and height (integers), format (an enumeration), data (u8),
/// stride (an integer, bytes from row to row) of one whose rows may have gaps, and size (an
/// integer, bytes of data) of one that may be compressed.
struct PictureLayout {
  const FieldDescriptor* width = nullptr;
  const FieldDescriptor* height = nullptr;
  const FieldDescriptor* format = nullptr;
  const FieldDescriptor* data = nullptr;
  const FieldDescriptor* stride = nullptr;  ///< null: rows without gaps
  const FieldDescriptor* size = nullptr;    ///< null: never compressed

  static PictureLayout of(const TypeDescriptor& type) noexcept;
  bool is_complete() const noexcept;
};

/// Any one thread; keeps its memory.
class PictureEncoder {
 public:
  PictureEncoder() noexcept = default;
  PictureEncoder(const PictureEncoder&) = delete;
  PictureEncoder& operator=(const PictureEncoder&) = delete;
  ~PictureEncoder();

  /// One that is a JPEG already (mjpeg) is passed on as it is, and lies where the image does.
  /// Formats (the enumeration's names): grey8, grey16 (its high bytes), rgb24, bgr24, yuyv, uyvy, nv12,
  /// bayer_rggb8, bayer_grbg8, bayer_gbrg8, bayer_bggr8. Scaled by the least whole number
  /// that makes it at most `width` pixels wide. The JPEG is valid until the next call; empty: cause() says
  /// why there is none.
  std::string_view encode(const PictureLayout& layout, const void* image, std::uint32_t width);
  /// By how much each side of the last JPEG is smaller than the image's: 1 and more, 0 where there is none.
  std::uint16_t scaled_by() const noexcept { return scaled_by_; }
  const char* cause() const noexcept { return cause_; }

 private:
  std::string_view pass_on(const PictureLayout& layout, const void* image);
  /// `row_bytes`: from row to row; 0: rows without gaps.
  bool scale(std::string_view format, const std::byte* data, std::size_t size, std::size_t columns,
             std::size_t rows, std::size_t row_bytes, std::size_t by);

  void* compressor_ = nullptr;
  const char* cause_ = "";
  std::uint16_t scaled_by_ = 0;
  std::size_t columns_ = 0;
  std::size_t rows_ = 0;
  int pixel_format_ = 0;
  std::vector<unsigned char> pixels_;
  std::vector<unsigned char> jpeg_;
};

}  // namespace flexrf::panel
