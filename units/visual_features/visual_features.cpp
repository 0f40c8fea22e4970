#include "units/visual_features/visual_features.hpp"

#include <memory>

#include "units/vision/camera_view.hpp"
#include "units/vision/edge_sharpness.hpp"
#include "units/vision/hidden_part.hpp"
#include "units/vision/part_model.hpp"

namespace flexrf::user {
namespace {

// So many pictures in a row that go on from each other are a camera that counts anew.
constexpr std::uint32_t new_count = 10;
// So many good ones in a row are said to be well again: one in between does not mend a camera.
constexpr std::uint32_t well_again = 10;
// So many pictures in a row in which the table's colour is not found: the light has changed to what is none.
constexpr std::uint32_t most_without_light = 15;
constexpr double least_deviation = 12;  // of luminance, 0 to 255: below it edges are the sensor's own noise

}  // namespace

Status FeatureExtraction::initialise() {
  extractor_.forget();
  const auto parts = std::make_unique<KnownParts>();
  if (const Status status = parts->take(configuration.catalogue); !status) return status;
  classes_.prepare(parts->all(), configuration.catalogue.table, 0);
  light_.forget();
  without_light_ = 0;
  heard_ = Time{};
  sequence_ = other_sequence_ = 0;
  others_ = 0;
  any_ = false;
  good_ = 0;
  feedback.state = PictureState::waiting;
  feedback.set_trouble({});
  return check_camera(configuration.camera);
}

void FeatureExtraction::step(const Tick& tick) {
  look(tick);
  PictureCondition now{};
  now.state = feedback.state;
  now.set_trouble(feedback.trouble_view());
  condition.publish(now);
}

void FeatureExtraction::look(const Tick& tick) noexcept {
  if (heard_ == Time{}) heard_ = tick.now;
  const auto frame = frames.latest();
  if (!frame || !frame.is_new()) {
    if (tick.now - heard_ < duration_of(runtime.silence)) return;
    extractor_.forget();
    comes_seldom_ = feedback.state == PictureState::silent && (comes_seldom_ || good_ > 0);
    good_ = 0;
    const bool has_writer = frame || frame.reason() == NullReason::nothing_yet;
    note(PictureState::silent, !has_writer     ? "there is no camera: its device was stopped or is in fault"
                               : comes_seldom_ ? "pictures come too seldom: look at the camera's device"
                                               : "no picture comes: look at the camera's device");
    return;
  }
  heard_ = tick.now;
  feedback.missed += frame.missed();
  if (!has_usable_format(*frame)) {
    refuse(PictureState::wrong_format,
           "a picture is not rgb24 of 640x480: set the camera's format, width and height so");
  } else if (is_in_order(*frame)) {
    extract(*frame, frame.sampled_at());
  }
}

bool FeatureExtraction::has_usable_format(const CameraFrame& frame) const noexcept {
  return frame.format == PixelFormat::rgb24 && frame.width == picture_width &&
         frame.height == picture_height && frame.stride >= picture_row_bytes &&
         std::uint64_t{frame.stride} * (picture_height - 1) + picture_row_bytes <= frame.data().size();
}

/// The count rises from picture to picture, also when the camera was away.
bool FeatureExtraction::is_in_order(const CameraFrame& frame) noexcept {
  if (!any_ || frame.sequence > sequence_) {
    any_ = true;
    others_ = 0;
    sequence_ = frame.sequence;
    return true;
  }
  if (frame.sequence == sequence_) {
    refuse(PictureState::frozen, "the camera repeats a picture: its count stands");
    return false;
  }
  others_ = others_ > 0 && frame.sequence > other_sequence_ ? others_ + 1 : 1;
  other_sequence_ = frame.sequence;
  if (others_ < new_count) {
    refuse(PictureState::out_of_order, "a picture is older than one that came before it");
    return false;
  }
  log_info(name(), "the camera counts its pictures anew, from {}", frame.sequence);
  others_ = 0;
  sequence_ = frame.sequence;
  return true;
}

void FeatureExtraction::extract(const CameraFrame& frame, Time sampled_at) noexcept {
  auto loan = features.loan();
  if (!loan) {
    refuse(PictureState::good, "the features' slot is not connected, or has no buffer left");
    return;
  }
  const PictureStatistics of = extractor_.extract(frame.data().data(), frame.stride, *loan);
  feedback.brightness = of.brightness / 255;
  feedback.deviation = of.deviation / 255;
  feedback.edge = of.deviation > 0 ? of.edge / of.deviation : 0.0;
  if (feedback.brightness < runtime.black) {
    refuse(PictureState::black, "the picture is black: is the lens covered, or the light out?");
    return;
  }
  if (of.deviation > least_deviation && feedback.edge > runtime.noise) {
    refuse(PictureState::noise, "the picture is noise: look at the camera and its cable");
    return;
  }
  if (!is_well_lit(frame)) return;
  feedback.sharpness = edge_sharpness(extractor_.luminance(), feature_width).value_or(1.0);
  if (feedback.sharpness < runtime.blurred) {
    refuse(PictureState::blurred,
           "the picture is blurred: look at the lens, its focus, and whether something is on it");
    return;
  }
  loan->white_balance = light_.balance().gain;
  loan->sees_table = without_light_ == 0;
  if (!loan->sees_table) ++feedback.without_light;
  loan->frame = frame.sequence;
  loan->time = frame.time;
  loan.publish(sampled_at);
  ++feedback.pictures;
  ++good_;
  if (feedback.state == PictureState::waiting || good_ >= well_again) note(PictureState::good, "");
}

/// False, and the picture refused: in such light recognition would take an obstacle for a shadow, the table
/// or a part. The table fills most of a picture, so its brightness and colour tell the light.
bool FeatureExtraction::is_well_lit(const CameraFrame& frame) noexcept {
  if (feedback.brightness < runtime.dark) {
    refuse(PictureState::too_dark, "the picture is too dark to tell obstacles from shadows: give more light");
    return false;
  }
  if (feedback.brightness > runtime.bright) {
    refuse(PictureState::too_bright, "the picture is too bright, its colours are saturated: give less light");
    return false;
  }
  const PictureView picture{frame.data().data(), frame.stride, static_cast<int>(frame.width),
                            static_cast<int>(frame.height)};
  // From near above an obstacle the table is hidden, but not for long.
  const auto hand = in_hand.latest();
  const PixelRectangle blind = hidden_part(configuration.camera, hand ? &*hand : nullptr);
  without_light_ = light_.look(picture, blind, classes_) ? 0 : without_light_ + 1;
  if (!light_.sees_no_grey() && without_light_ < most_without_light) return true;
  refuse(
      PictureState::colour_cast,
      "the light is coloured, nothing has the colour of the table: colours cannot be told; give white light");
  return false;
}

/// What was refused is nothing to compare the next picture with.
void FeatureExtraction::refuse(PictureState state, const char* trouble) noexcept {
  ++feedback.refused;
  good_ = 0;
  extractor_.forget();
  note(state, trouble);
}

void FeatureExtraction::note(PictureState state, const char* trouble) noexcept {
  if (feedback.state == state && feedback.trouble_view() == trouble) return;
  const bool was_well = feedback.state == PictureState::good || feedback.state == PictureState::waiting;
  feedback.state = state;
  feedback.set_trouble(trouble);
  if (trouble[0] != '\0')
    log_warning(said_[static_cast<std::size_t>(state)], name(), "{}", trouble);
  else if (!was_well)
    log_info(name(), "pictures are good again");
}

}  // namespace flexrf::user
