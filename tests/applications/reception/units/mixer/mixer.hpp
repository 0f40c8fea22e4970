#pragma once

#include "mixer_unit.hpp"

namespace flexrf::user {

class Mixer final : public MixerUnit {
 public:
  Status accept(const Runtime& proposed) override {
    if (proposed.count == 13) return Status::error(StatusCode::not_permitted, "13 brings bad luck");
    return {};
  }
  void step(const Tick& /*tick*/) override {
    feedback.kicks += runtime.kick;
    at_ += runtime.gain;
    Pose place{};
    place.position[0] = at_;
    pose.publish(place);
    for (std::uint32_t press = 0; press < runtime.kick; ++press) kicked.push(place);
  }

 private:
  double at_ = 0;
};

}  // namespace flexrf::user
