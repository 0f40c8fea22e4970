#include "hal/camera/interface/jpeg_maker.hpp"

#include <turbojpeg.h>

#include "runtime/realtime/realtime_scope.hpp"

namespace flexrf {
namespace {

constexpr int qualities[] = {80, 40, 10, 1};
constexpr std::size_t most_pixels = std::size_t{3840} * 2160;

}  // namespace

JpegMaker::~JpegMaker() {
  if (compressor_ != nullptr) tjDestroy(compressor_);
}

Status JpegMaker::begin(std::uint32_t width, std::uint32_t height) {
  if (std::size_t{width} * height > most_pixels) {
    return Status::error(StatusCode::out_of_range,
                         "a picture of %ux%u pixels is not made up here; ask for at most 3840x2160", width,
                         height);
  }
  if (compressor_ == nullptr) compressor_ = tjInitCompress();
  if (compressor_ == nullptr)
    return Status::error(StatusCode::internal, "libturbojpeg cannot begin: %s", tjGetErrorStr2(nullptr));
  width_ = static_cast<int>(width);
  height_ = static_cast<int>(height);
  canvas_.assign(std::size_t{width} * height * 3, 0);
  jpeg_.assign(tjBufSize(width_, height_, TJSAMP_422), 0);
  return {};
}

std::span<const std::uint8_t> JpegMaker::make(std::size_t room) noexcept {
  const AllocationAllowed as_libturbojpeg_does;
  for (const int quality : qualities) {
    unsigned char* to = jpeg_.data();
    unsigned long size = jpeg_.size();
    if (tjCompress2(compressor_, canvas_.data(), width_, 0, height_, TJPF_RGB, &to, &size, TJSAMP_422,
                    quality, TJFLAG_NOREALLOC) != 0)
      return {};
    if (size <= room) return std::span<const std::uint8_t>(jpeg_).first(size);
  }
  return {};
}

}  // namespace flexrf
