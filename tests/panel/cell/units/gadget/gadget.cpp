#include "units/gadget/gadget.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace flexrf::user {

Status Gadget::initialise() {
  if (configuration.size == 1.3)
    return Status::error(StatusCode::device_fault, "a size of 1.3 m does not fit in");
  size_ = configuration.size;
  ++initialised_;
  return {};
}

Status Gadget::accept(const Runtime& proposed) {
  if (proposed.level > 9 && !proposed.enabled)
    return Status::error(StatusCode::out_of_range, "a level above 9 needs it to be enabled");
  return {};
}

void Gadget::step(const Tick& tick) {
  const double seconds = std::chrono::duration<double>(tick.now.time_since_epoch()).count();
  const double wave = std::sin(seconds);
  Sample all;
  all.number = runtime.offset + wave;
  all.flag = std::fmod(seconds, 2) < 1;
  all.tint = runtime.tint;
  all.set_title(runtime.title_view());
  all.vector = {wave, 2 * wave, 3 * wave};
  all.matrix_map().setConstant(static_cast<float>(wave));
  all.spots[0] = {wave, true};
  sample.publish(all);
  Pose pose{};
  pose.position = {std::cos(seconds), wave, 0};
  pose.orientation = {0, 0, std::sin(seconds / 2), std::cos(seconds / 2)};
  place.publish(pose);
  if (tick.number % 8 == 0) tasks.push({static_cast<std::uint32_t>(tick.number)});

  feedback.level = runtime.level;
  feedback.knocks += runtime.knock;
  feedback.enabled = runtime.enabled;
  feedback.tint = runtime.tint;
  feedback.set_title(runtime.title_view());
  feedback.turns = runtime.turns;
  ++feedback.spread[static_cast<std::size_t>(std::clamp((wave + 1) * 8, 0.0, 15.0))];
  feedback.initialised = initialised_;
  feedback.size = size_;
}

}  // namespace flexrf::user
