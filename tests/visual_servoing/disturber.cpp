#include "tests/visual_servoing/disturber.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "hal/scene/interface/part_catalogue.hpp"
#include "types/pose.hpp"

namespace flexrf::visual_servoing {
namespace {

// The ranges of the table's parameters.
constexpr double darkest = 0.2;
constexpr double brightest = 2.0;
constexpr double lowest_light = 0.5;  // rad
constexpr double most_tint = 0.5;
constexpr double takes_effect = 0.05;  // s, until a place that was set is used

bool goes_blind(PickerState state) {
  return state == PickerState::descending || state == PickerState::closing || state == PickerState::lifting ||
         state == PickerState::lowering || state == PickerState::releasing;
}

std::string text_of(const char* what, double x, double y) {
  char text[80];
  std::snprintf(text, sizeof(text), "%s %.3f %.3f", what, x, y);
  return text;
}

}  // namespace

void Disturber::look() {
  const double now = cell_.elapsed();
  if (uncover_ > 0 && now >= uncover_) {
    cell_.set("table", "cover_lens", false);
    uncover_ = 0;
    tell("lens free");
  }
  if (now < next_) return;
  if (button_ != nullptr) {
    if (!is_too_near()) cell_.press("table", button_);
    button_ = nullptr;
    next_ = now + random_.between(1, 6);
    return;
  }
  begin();
}

void Disturber::begin() {
  next_ = cell_.elapsed() + random_.between(1, 6);
  const std::uint32_t what = random_.below(100);
  if (what < 25) return change_light();
  if (what < 65) {
    choose_place();
    if (is_too_near()) return;
    cell_.set("table", "place", place_);
    button_ = "add_obstacle";
    if (what >= 50) {
      button_ = "push_part";
      cell_.set("table", "push_way", random_.between(0.005, 0.1));
      cell_.set("table", "push_azimuth", random_.between(-std::numbers::pi, std::numbers::pi));
    }
    next_ = cell_.elapsed() + takes_effect;
    return tell(text_of(button_, place_[0], place_[1]));
  }
  if (what < 82) {
    cell_.press("table", "remove_obstacles");
    return tell("obstacles taken away");
  }
  if (what < 96) {
    cell_.set("table", "cover_lens", true);
    uncover_ = cell_.elapsed() + random_.between(0.2, 3);
    return tell("lens covered");
  }
  if (goes_blind(cell_.picker().state)) return;
  cell_.press("table", "lay_table");
  ++tables_;
  tell("table laid again");
}

/// Sets the usual light, or another one: each end of a range as often as all that lies between.
void Disturber::change_light() {
  const bool is_usual = random_.below(2) == 0;
  const auto value = [&](double low, double high, double usual) {
    if (is_usual) return usual;
    const std::uint32_t end = random_.below(4);
    return end == 0 ? low : end == 1 ? high : random_.between(low, high);
  };
  const double intensity = value(darkest, brightest, 1);
  const double azimuth = value(-std::numbers::pi, std::numbers::pi, 0.9);
  const double elevation = value(lowest_light, 1.57, 1.1);
  const std::array<double, 3> tint{value(-most_tint, most_tint, 0), value(-most_tint, most_tint, 0),
                                   value(-most_tint, most_tint, 0)};
  cell_.set("table", "light_intensity", intensity);
  cell_.set("table", "light_azimuth", azimuth);
  cell_.set("table", "light_elevation", elevation);
  cell_.set("table", "light_tint", tint);
  char text[120];
  std::snprintf(text, sizeof(text), "light %.2f, azimuth %.2f, elevation %.2f, tint %.2f %.2f %.2f",
                intensity, azimuth, elevation, tint[0], tint[1], tint[2]);
  tell(text);
}

void Disturber::choose_place() {
  const std::uint32_t where = random_.below(3);
  PlaneVector middle{cell_.picker().target_place[0], cell_.picker().target_place[1]};
  if (where == 1) middle = part_bins[random_.below(part_kinds)].middle;
  if (where == 2)
    middle = {random_.between(parts_area_from.x, parts_area_to.x),
              random_.between(parts_area_from.y, parts_area_to.y)};
  const double away = where == 2 ? 0 : random_.between(0.02, 0.12);
  const double azimuth = random_.between(-std::numbers::pi, std::numbers::pi);
  place_ = {middle.x + away * std::cos(azimuth), middle.y + away * std::sin(azimuth)};
}

bool Disturber::is_too_near() const {
  if (!goes_blind(cell_.picker().state)) return false;
  const auto tool = cell_.newest<Pose>("tool_pose");
  return std::hypot(tool.position[0] - place_[0], tool.position[1] - place_[1]) < hands_off;
}

void Disturber::tell(const std::string& deed) {
  deed_ = deed;
  if (verbose) std::printf("%8.3f      a person: %s\n", cell_.elapsed(), deed.c_str());
}

}  // namespace flexrf::visual_servoing
