#include "tests/visual_servoing/pick_judge.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "hal/scene/interface/part_catalogue.hpp"

namespace flexrf::visual_servoing {
namespace {

double turn_within(double angle, int symmetry) {
  if (symmetry == 0) return 0;
  return std::abs(std::remainder(angle, 2 * std::numbers::pi / symmetry));
}

}  // namespace

void PickJudge::look() {
  const PartPickerFeedback& told = cell_.picker();
  if (told.state != state_ && verbose)
    std::printf("%8.3f  %2d  %s\n", cell_.elapsed(), static_cast<int>(told.state), cell_.message().c_str());
  if (told.state != state_ && verbose && told.state == PickerState::blocked) tell_obstacles();
  if (is_under_way_ && told.binned != binned_) {
    end("", true);
  } else if (is_under_way_ && told.state != state_) {
    switch (told.state) {
      case PickerState::looking:
      case PickerState::descending:
      case PickerState::lifting:
      case PickerState::carrying:
      case PickerState::looking_into_bin:
      case PickerState::lowering:
      case PickerState::releasing:
        break;
      case PickerState::closing:
        measure();
        break;
      default:
        end(cell_.message(), false);
    }
  }
  if (told.approaches != begun_) {
    now_ = Approach{};
    now_.began = cell_.elapsed();
    now_.kind = told.target_kind;
    is_under_way_ = true;
  }
  begun_ = told.approaches;
  binned_ = told.binned;
  state_ = told.state;
}

void PickJudge::tell_obstacles() const {
  const auto list = cell_.newest<TrackList>("tracks");
  for (const ObjectTrack& track : list.tracks)
    if (track.found == VisualClass::obstacle)
      std::printf(
          "%8.3f      obstacle %u at %.3f %.3f, radius %.3f, height %.3f, %s, in %u pictures, missed %u\n",
          cell_.elapsed(), track.identity, track.position[0], track.position[1], track.radius,
          track.body_height, track.confirmed ? "confirmed" : "not confirmed", track.frames, track.misses);
}

void PickJudge::measure() {
  const PartPickerFeedback& told = cell_.picker();
  const auto scene = cell_.newest<SceneState>("scene");
  const PartModel& model = part_catalogue[told.target_kind];
  now_.closed = true;
  now_.place_error = 1;
  for (const SceneBody& part : scene.parts) {
    if (part.kind != model.kind) continue;
    const double error =
        std::hypot(part.position[0] - told.target_place[0], part.position[1] - told.target_place[1]);
    if (error >= now_.place_error) continue;
    now_.place_error = error;
    now_.angle_error = turn_within(part.angle - told.target_place[2], model.symmetry);
  }
  if (verbose)
    std::printf("%8.3f      %s is off by %.2f mm, %.2f degrees\n", cell_.elapsed(), model.name,
                1000 * now_.place_error, now_.angle_error * 180 / std::numbers::pi);
}

void PickJudge::end(const std::string& cause, bool binned) {
  now_.ended = cell_.elapsed();
  now_.cause = cause;
  now_.binned = binned;
  approaches_.push_back(now_);
  is_under_way_ = false;
}

std::size_t PickJudge::good() const {
  return static_cast<std::size_t>(std::count_if(approaches_.begin(), approaches_.end(),
                                                [](const Approach& one) { return one.is_good(); }));
}

}  // namespace flexrf::visual_servoing
