#include "hal/camera/conformance/mjpeg_cases.hpp"

#include "base/text.hpp"
#include "hal/camera/conformance/camera_eye.hpp"
#include "hal/camera/interface/jpeg_check.hpp"

namespace flexrf {
namespace {

bool is_a_whole_jpeg(const CameraImage& image, const CameraRequest& request) {
  const CheckedJpeg checked = check_jpeg(image.data, request.width, request.height);
  return checked.damage == nullptr && checked.size == image.data.size() && image.stride == 0 &&
         image.format == PixelFormat::mjpeg && image.width == request.width && image.height == request.height;
}

Verdict pictures_are_whole_jpegs(CameraWorld& world, bool into_slot) {
  if (!world.compresses()) return Verdict::skipped;
  const CameraRequest request{.format = PixelFormat::mjpeg, .into_slot = into_slot};
  if (!world.start(request)) return Verdict::failed;
  CameraEye eye(world);
  std::uint64_t sum = 0;
  bool changes = false;
  for (int i = 0; i < 5; ++i) {
    const auto image = eye.next();
    if (!image || !is_a_whole_jpeg(*image, request)) return Verdict::failed;
    changes = changes || (i > 0 && checksum(*image) != sum);
    sum = checksum(*image);
  }
  return verdict(changes && world.feedback().damaged_frames == 0);
}

}  // namespace

// [camera-7]
Verdict a_unit_sees_compressed_pictures(CameraWorld& world) {
  return pictures_are_whole_jpegs(world, false);
}

// [camera-7]
Verdict a_slot_gets_compressed_pictures(CameraWorld& world) {
  return pictures_are_whole_jpegs(world, true);
}

// [camera-7]
Verdict half_a_compressed_picture_is_counted_and_not_shown(CameraWorld& world) {
  if (!world.compresses()) return Verdict::skipped;
  const CameraRequest request{.format = PixelFormat::mjpeg, .into_slot = true};
  if (!world.start(request)) return Verdict::failed;
  CameraEye eye(world);
  const auto before = eye.next();
  if (!before) return Verdict::failed;
  const std::uint64_t sequence = before->sequence;
  if (!world.damage()) return Verdict::skipped;
  const auto after = eye.next();
  const CameraFeedback& told = world.feedback();
  return verdict(after && is_a_whole_jpeg(*after, request) && after->sequence == sequence + 2 &&
                 told.damaged_frames == 1 && told.lost_frames == 0 && told.present &&
                 text_view(told.damage).find("ends before") != std::string_view::npos);
}

}  // namespace flexrf
