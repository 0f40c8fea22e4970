#include "web-ui/server/api/picture.hpp"

#include <turbojpeg.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <string_view>

#include "runtime/parameters/value_access.hpp"

namespace flexrf::panel {
namespace {

constexpr int quality = 80;
/// Of one side: more is no camera.
constexpr double largest_side = 16384;

const FieldDescriptor* field(const TypeDescriptor& type, std::string_view name) noexcept {
  const auto found =
      std::find_if(type.fields.begin(), type.fields.end(),
                   [name](const FieldDescriptor& candidate) { return name == candidate.name; });
  return found == type.fields.end() ? nullptr : &*found;
}

std::size_t side(const FieldDescriptor& descriptor, const void* image) noexcept {
  const Result<double> number = read_number(whole(descriptor), image);
  return number && *number >= 1 && *number <= largest_side ? static_cast<std::size_t>(*number) : 0;
}

/// Mean of `by` times `by` values, `step` bytes apart in a row.
unsigned char mean(const std::byte* from, std::size_t step, std::size_t row_bytes, std::size_t by) noexcept {
  std::size_t sum = 0;
  for (std::size_t y = 0; y < by; ++y) {
    for (std::size_t x = 0; x < by; ++x) sum += std::to_integer<std::size_t>(from[y * row_bytes + x * step]);
  }
  return static_cast<unsigned char>(sum / (by * by));
}

unsigned char clamped(double value) noexcept {
  return static_cast<unsigned char>(std::clamp(value + 0.5, 0.0, 255.0));
}

/// ITU-R BT.601, full range as JPEG has it, of the pixels that share U and V.
void to_rgb(double y, double u, double v, unsigned char* rgb) noexcept {
  rgb[0] = clamped(y + 1.402 * (v - 128));
  rgb[1] = clamped(y - 0.344136 * (u - 128) - 0.714136 * (v - 128));
  rgb[2] = clamped(y + 1.772 * (u - 128));
}

constexpr std::string_view bayer = "bayer_";  // then the colours of two by two pixels, as "rggb8"

/// Of a block of `by` times `by` pixels behind a mosaic whose cells of two by two begin at even columns and
/// rows; from the cell in which it begins.
void mosaic_to_rgb(const std::byte* data, std::size_t columns, std::size_t rows, std::size_t row_bytes,
                   std::size_t x, std::size_t y, std::size_t by, std::string_view colours,
                   unsigned char* rgb) noexcept {
  const std::size_t left = std::min(x * by, columns - 2) / 2 * 2;
  const std::size_t top = std::min(y * by, rows - 2) / 2 * 2;
  const std::size_t cells = std::max<std::size_t>(by / 2, 1);
  std::size_t sums[3] = {};
  std::size_t counts[3] = {};
  for (std::size_t place = 0; place < 4; ++place) {
    const std::size_t channel = colours[place] == 'r' ? 0 : colours[place] == 'g' ? 1 : 2;
    const std::byte* const from = data + (top + place / 2) * row_bytes + left + place % 2;
    for (std::size_t cell = 0; cell < cells * cells; ++cell)
      sums[channel] += std::to_integer<std::size_t>(from[cell / cells * 2 * row_bytes + cell % cells * 2]);
    counts[channel] += cells * cells;
  }
  for (std::size_t channel = 0; channel < 3; ++channel)
    rgb[channel] = static_cast<unsigned char>(sums[channel] / counts[channel]);
}

/// As encode() takes them, but for mjpeg.
constexpr std::string_view plain_formats[] = {"grey8",       "grey16",      "rgb24",      "bgr24",
                                              "yuyv",        "uyvy",        "nv12",       "bayer_rggb8",
                                              "bayer_grbg8", "bayer_gbrg8", "bayer_bggr8"};

}  // namespace

PictureLayout PictureLayout::of(const TypeDescriptor& type) noexcept {
  return {field(type, "width"), field(type, "height"), field(type, "format"),
          field(type, "data"),  field(type, "stride"), field(type, "size")};
}

bool PictureLayout::is_complete() const noexcept {
  return width != nullptr && height != nullptr && format != nullptr && data != nullptr &&
         format->scalar == Scalar::enumeration && data->scalar == Scalar::u8;
}

PictureEncoder::~PictureEncoder() {
  if (compressor_ != nullptr) tjDestroy(compressor_);
}

bool PictureEncoder::scale(std::string_view format, const std::byte* data, std::size_t size,
                           std::size_t columns, std::size_t rows, std::size_t row_bytes, std::size_t by) {
  const bool is_nv12 = format == "nv12";
  const bool is_uyvy = format == "uyvy";
  const bool is_in_pairs = is_uyvy || format == "yuyv";
  const bool is_mosaic = format.starts_with(bayer);
  const bool is_grey16 = format == "grey16";
  const std::size_t pixel = format == "grey8" || is_nv12 || is_mosaic ? 1 : is_in_pairs || is_grey16 ? 2 : 3;
  // Colour is shared by two columns, in nv12 by two rows as well, whose own rows come behind the others.
  const std::size_t least_row = (is_nv12 || is_in_pairs ? (columns + 1) / 2 * 2 : columns) * pixel;
  const std::size_t data_rows = is_nv12 ? rows + (rows + 1) / 2 : rows;
  row_bytes = std::max(row_bytes, least_row);
  if (row_bytes * (data_rows - 1) + least_row > size) {
    cause_ = "the picture is larger than its data";
    return false;
  }
  if (is_mosaic && (columns < 2 || rows < 2)) {
    cause_ = "the picture is smaller than a cell of its mosaic";
    return false;
  }
  columns_ = columns / by;
  rows_ = rows / by;
  const std::size_t out = format == "grey8" || is_grey16 ? 1 : 3;
  pixels_.resize(columns_ * rows_ * out);
  unsigned char* to = pixels_.data();
  for (std::size_t y = 0; y < rows_; ++y) {
    const std::byte* const row = data + y * by * row_bytes;
    for (std::size_t x = 0; x < columns_; ++x, to += out) {
      const std::byte* const from = row + x * by * pixel;
      // Colour of the pair or square in which the block begins.
      if (is_in_pairs) {
        const std::byte* const pair = row + (x * by / 2) * 4 + (is_uyvy ? 0 : 1);
        to_rgb(mean(from + (is_uyvy ? 1 : 0), 2, row_bytes, by), std::to_integer<int>(pair[0]),
               std::to_integer<int>(pair[2]), to);
      } else if (is_grey16) {
        *to = mean(from + 1, 2, row_bytes, by);  // the high bytes
      } else if (is_mosaic) {
        mosaic_to_rgb(data, columns, rows, row_bytes, x, y, by, format.substr(bayer.size()), to);
      } else if (is_nv12) {
        const std::byte* const square = data + (rows + y * by / 2) * row_bytes + (x * by / 2) * 2;
        to_rgb(mean(from, 1, row_bytes, by), std::to_integer<int>(square[0]), std::to_integer<int>(square[1]),
               to);
      } else {
        for (std::size_t channel = 0; channel < out; ++channel)
          to[channel] = mean(from + channel, pixel, row_bytes, by);
      }
    }
  }
  pixel_format_ = out == 1 ? TJPF_GRAY : format == "bgr24" ? TJPF_BGR : TJPF_RGB;
  return true;
}

/// Its receiver decodes it; what is damaged the camera's driver has left out.
std::string_view PictureEncoder::pass_on(const PictureLayout& layout, const void* image) {
  const Result<double> size =
      layout.size == nullptr ? Result<double>(0.0) : read_number(whole(*layout.size), image);
  const auto* const data = static_cast<const char*>(image) + layout.data->offset;
  if (!size || *size < 2 || *size > layout.data->count || data[0] != '\xFF' || data[1] != '\xD8') {
    cause_ = "the picture is not the JPEG that it says it is";
    return {};
  }
  scaled_by_ = 1;
  return {data, static_cast<std::size_t>(*size)};
}

std::string_view PictureEncoder::encode(const PictureLayout& layout, const void* image, std::uint32_t width) {
  const std::size_t columns = side(*layout.width, image);
  const std::size_t rows = side(*layout.height, image);
  const auto number = static_cast<std::size_t>(*read_number(whole(*layout.format), image));
  const auto& formats = layout.format->type->values;
  const std::string_view format = number < formats.size() ? formats[number].name : "";
  cause_ = "";
  scaled_by_ = 0;
  if (columns == 0 || rows == 0) {
    cause_ = "the picture is empty";
  } else if (format == "mjpeg") {
    return pass_on(layout, image);
  } else if (std::find(std::begin(plain_formats), std::end(plain_formats), format) ==
             std::end(plain_formats)) {
    cause_ =
        "the picture's format is none of grey8, grey16, rgb24, bgr24, yuyv, uyvy, nv12, mjpeg, bayer_...8";
  }
  if (cause_[0] != '\0') return {};
  const std::size_t wanted = std::max<std::size_t>(width, 16);
  const std::size_t by = std::min({(columns + wanted - 1) / wanted, columns, rows});
  const auto* const data = static_cast<const std::byte*>(image) + layout.data->offset;
  const Result<double> stride =
      layout.stride == nullptr ? Result<double>(0.0) : read_number(whole(*layout.stride), image);
  const std::size_t row_bytes =
      stride && *stride > 0 && *stride <= layout.data->count ? static_cast<std::size_t>(*stride) : 0;
  if (!scale(format, data, layout.data->count, columns, rows, row_bytes, by)) return {};
  if (compressor_ == nullptr) compressor_ = tjInitCompress();
  const int sampling = pixel_format_ == TJPF_GRAY ? TJSAMP_GRAY : TJSAMP_420;
  const auto shown_columns = static_cast<int>(columns_);
  const auto shown_rows = static_cast<int>(rows_);
  const unsigned long bound = tjBufSize(shown_columns, shown_rows, sampling);
  if (jpeg_.size() < bound) jpeg_.resize(bound);
  unsigned char* buffer = jpeg_.data();
  unsigned long size = jpeg_.size();
  if (compressor_ == nullptr ||
      tjCompress2(compressor_, pixels_.data(), shown_columns, 0, shown_rows, pixel_format_, &buffer, &size,
                  sampling, quality, TJFLAG_NOREALLOC | TJFLAG_FASTDCT) != 0) {
    cause_ = "the picture could not be encoded";
    return {};
  }
  static_assert(largest_side <= std::numeric_limits<std::uint16_t>::max());
  scaled_by_ = static_cast<std::uint16_t>(by);
  return {reinterpret_cast<const char*>(buffer), size};
}

}  // namespace flexrf::panel
