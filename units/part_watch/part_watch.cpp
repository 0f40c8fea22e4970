#include "units/part_watch/part_watch.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include "base/status.hpp"

namespace flexrf::user {
namespace {

// However large the picture is, a step ends: so many pixels of each direction are looked at.
constexpr std::uint32_t most_samples = 64;

// Where the brightness of a pixel lies, and how much each byte counts (BT.601).
struct PixelLayout {
  std::uint32_t bytes = 0;  // from one pixel to the next
  std::array<double, 3> weights{};
};

std::optional<PixelLayout> layout_of(PixelFormat format) {
  switch (format) {
    case PixelFormat::grey8:
    case PixelFormat::nv12:  // its colour comes behind, and does not matter here
      return PixelLayout{1, {1, 0, 0}};
    case PixelFormat::yuyv:
      return PixelLayout{2, {1, 0, 0}};
    case PixelFormat::uyvy:
      return PixelLayout{2, {0, 1, 0}};
    case PixelFormat::grey16:
      return PixelLayout{2, {1.0 / 257, 256.0 / 257, 0}};
    case PixelFormat::rgb24:
      return PixelLayout{3, {0.299, 0.587, 0.114}};
    case PixelFormat::bgr24:
      return PixelLayout{3, {0.114, 0.587, 0.299}};
    case PixelFormat::bayer_rggb8:
    case PixelFormat::bayer_grbg8:
    case PixelFormat::bayer_gbrg8:
    case PixelFormat::bayer_bggr8:
    case PixelFormat::mjpeg:
    case PixelFormat::none:
      break;
  }
  return std::nullopt;
}

// Of one colour each: which pixels are looked at would make a difference.
bool is_mosaic(PixelFormat format) {
  return format == PixelFormat::bayer_rggb8 || format == PixelFormat::bayer_grbg8 ||
         format == PixelFormat::bayer_gbrg8 || format == PixelFormat::bayer_bggr8;
}

// A part of a row or column: at least one pixel of it.
struct Range {
  std::uint32_t first = 0;
  std::uint32_t count = 1;
};

Range range_of(double begin, double part, std::uint32_t size) {
  const auto first = std::min(static_cast<std::uint32_t>(begin * size), size - 1);
  const auto count = static_cast<std::uint32_t>(part * size);
  return {first, std::clamp(count, 1U, size - first)};
}

}  // namespace

void PartWatch::step(const Tick& /*tick*/) {
  const auto frame = picture.latest();
  if (!frame) {
    feedback.set_trouble(name_of(frame.reason()));
    return;
  }
  if (!frame.is_new()) return;
  if (frame->format == PixelFormat::mjpeg) {
    feedback.set_trouble("the picture is compressed (mjpeg): take those of a jpeg_decoder");
    return;
  }
  if (is_mosaic(frame->format)) {
    feedback.set_trouble("the picture is its sensor's mosaic of colours: have the camera give yuyv or grey8");
    return;
  }
  const std::span<const std::uint8_t> data = frame->data();
  const auto layout = layout_of(frame->format);
  const std::uint64_t least_stride = layout ? std::uint64_t{frame->width} * layout->bytes : 0;
  if (!layout || frame->width == 0 || frame->height == 0 || frame->stride < least_stride ||
      std::uint64_t{frame->stride} * (frame->height - 1) + least_stride > data.size()) {
    feedback.set_trouble("the picture's format or size is not one that can be judged");
    return;
  }
  const Range columns = range_of(runtime.window[0], runtime.window[2], frame->width);
  const Range rows = range_of(runtime.window[1], runtime.window[3], frame->height);
  const std::uint32_t across = std::min(columns.count, most_samples);
  const std::uint32_t down = std::min(rows.count, most_samples);
  double sum = 0;
  for (std::uint32_t j = 0; j < down; ++j) {
    const std::size_t row = rows.first + std::size_t{j} * rows.count / down;
    for (std::uint32_t i = 0; i < across; ++i) {
      const std::size_t column = columns.first + std::size_t{i} * columns.count / across;
      const std::size_t place = row * frame->stride + column * layout->bytes;
      for (std::size_t k = 0; k < layout->bytes; ++k) sum += layout->weights[k] * data[place + k];
    }
  }
  PartSight seen{};
  seen.brightness = sum / (255.0 * across * down);
  seen.seen = runtime.part_is_bright == (seen.brightness >= runtime.threshold);
  sight.publish(seen, frame.sampled_at());
  feedback.brightness = seen.brightness;
  feedback.seen = seen.seen;
  ++feedback.pictures;
  feedback.set_trouble({});
}

}  // namespace flexrf::user
