// FeatureExtraction: integral images of the camera's pictures, and a judgement of whether they can be used.
//
// What is refused is not published: who reads the features sees the last good ones grow old. Each state is
// said once in the log when it begins, and once when pictures are good again. A good picture is used at once;
// that all is well is said after some in a row, as pictures out of order are good and refused by turns.
#pragma once

#include <array>

#include "runtime/log/log.hpp"
#include "units/vision/integral_images.hpp"
#include "units/vision/table_light.hpp"
#include "visual_features_unit.hpp"

namespace flexrf::user {

class FeatureExtraction final : public FeatureExtractionUnit {
 public:
  Status initialise() override;
  void step(const Tick& tick) override;

 private:
  bool is_in_order(const CameraFrame& frame) noexcept;
  bool has_usable_format(const CameraFrame& frame) const noexcept;
  void look(const Tick& tick) noexcept;
  void extract(const CameraFrame& frame, Time sampled_at) noexcept;
  bool is_well_lit(const CameraFrame& frame) noexcept;
  void note(PictureState state, const char* trouble) noexcept;
  void refuse(PictureState state, const char* trouble) noexcept;

  FeatureExtractor extractor_;
  ColourClasses classes_;
  TableLight light_;
  std::uint32_t without_light_ = 0;  // pictures in a row in which it was not found
  Time heard_{};                     // when the last picture came, or the first step was
  std::uint64_t sequence_ = 0;       // of the last picture that was in order
  bool any_ = false;
  // Of pictures out of order: where a camera began to count anew they are in order among themselves.
  std::uint64_t other_sequence_ = 0;
  std::uint32_t others_ = 0;
  std::uint32_t good_ = 0;         // in a row
  bool comes_seldom_ = false;      // while it is silent, some pictures came
  std::array<LogLimit, 12> said_;  // of each state
};

}  // namespace flexrf::user
