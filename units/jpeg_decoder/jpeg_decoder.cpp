#include "units/jpeg_decoder/jpeg_decoder.hpp"

#include <turbojpeg.h>

#include "base/status.hpp"

namespace flexrf::user {
namespace {

int pixels_of(PixelFormat format) {
  switch (format) {
    case PixelFormat::grey8:
      return TJPF_GRAY;
    case PixelFormat::rgb24:
      return TJPF_RGB;
    case PixelFormat::bgr24:
      return TJPF_BGR;
    default:
      return TJPF_UNKNOWN;
  }
}

}  // namespace

JpegDecoder::~JpegDecoder() {
  if (decompressor_ != nullptr) tjDestroy(decompressor_);
}

Status JpegDecoder::initialise() {
  if (pixels_of(configuration.format) == TJPF_UNKNOWN) {
    return Status::error(
        StatusCode::invalid_argument,
        "pictures are decoded to rgb24, bgr24 or grey8: set configuration.format to one of them");
  }
  if (decompressor_ == nullptr) decompressor_ = tjInitDecompress();
  if (decompressor_ == nullptr)
    return Status::error(StatusCode::internal, "libturbojpeg cannot begin: %s", tjGetErrorStr2(nullptr));
  feedback = {};
  return {};
}

void JpegDecoder::step(const Tick& /*tick*/) {
  const auto frame = picture.latest();
  if (!frame) {
    feedback.set_trouble(name_of(frame.reason()));
    return;
  }
  if (!frame.is_new()) return;
  if (frame->format != PixelFormat::mjpeg) {
    feedback.set_trouble("the picture is not compressed (mjpeg): give it to its readers as it is");
    return;
  }
  decode(*frame, frame.sampled_at());
}

void JpegDecoder::decode(const CameraFrame& from, Time sampled_at) {
  int width = 0;
  int height = 0;
  int sampling = 0;
  int colours = 0;
  const std::span<const std::uint8_t> jpeg = from.data();
  if (from.size > jpeg.size()) return leave_out("the picture is longer than its item");
  if (tjDecompressHeader3(decompressor_, jpeg.data(), from.size, &width, &height, &sampling, &colours) != 0)
    return leave_out(tjGetErrorStr2(decompressor_));
  const int layout = pixels_of(configuration.format);
  const std::size_t stride = static_cast<std::size_t>(width) * static_cast<std::size_t>(tjPixelSize[layout]);
  const std::size_t size = stride * static_cast<std::size_t>(height);
  if (pixels.is_connected() && size > pixels.elements()) return leave_out_for_want_of_room(size);
  auto to = pixels.loan();
  if (!to) return;
  // What it would only warn of is a picture with a part that was never sent.
  if (tjDecompress2(decompressor_, jpeg.data(), from.size, to->data().data(), width, 0, height, layout,
                    TJFLAG_STOPONWARNING) != 0)
    return leave_out(tjGetErrorStr2(decompressor_));
  to->width = static_cast<std::uint32_t>(width);
  to->height = static_cast<std::uint32_t>(height);
  to->stride = static_cast<std::uint32_t>(stride);
  to->size = static_cast<std::uint32_t>(size);
  to->format = configuration.format;
  to->time = from.time;
  to->sequence = from.sequence;
  to.publish(sampled_at);
  ++feedback.pictures;
  feedback.set_trouble({});
}

void JpegDecoder::leave_out_for_want_of_room(std::size_t size) {
  const auto status =
      Status::error(StatusCode::out_of_range,
                    "its pixels take %zu bytes, an item of the slot for them holds %zu: write "
                    "elements = %zu into the row of that slot ([slot.NAME])",
                    size, pixels.elements(), size);
  leave_out(status.cause());
}

void JpegDecoder::leave_out(const char* why) {
  ++feedback.damaged;
  feedback.set_trouble(why);
}

}  // namespace flexrf::user
