// LightMeter: measures the light of a picture as the unit of features does, for tests of other units.
#pragma once

#include "types/visual_features.hpp"
#include "units/vision/part_finder.hpp"
#include "units/vision/table_light.hpp"
#include "units/vision/tests/known_parts.hpp"

namespace flexrf::user {

class LightMeter {
 public:
  LightMeter() { classes_.prepare(known_parts(), known_table_colour(), 0); }
  /// `blind`: where nothing is seen.
  void look(const PictureView& picture, const PixelRectangle& blind = {}) {
    sees_table_ = light_.look(picture, blind, classes_);
  }
  void tell(PartFinder& finder) const { finder.set_light(light_.balance(), sees_table_); }
  void tell(VisualFeatures& of) const {
    of.white_balance = light_.balance().gain;
    of.sees_table = sees_table_;
  }

 private:
  ColourClasses classes_;
  TableLight light_;
  bool sees_table_ = false;
};

}  // namespace flexrf::user
