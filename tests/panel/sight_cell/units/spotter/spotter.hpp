#pragma once

#include <string_view>

#include "spotter_unit.hpp"
#include "tests/panel/sight_cell/seen_rectangles.hpp"

namespace flexrf::user {

class Spotter final : public SpotterUnit {
 public:
  void step(const Tick& /*tick*/) override {
    const auto of = view.latest();
    if (!of || !of.is_new() || runtime.stopped) return;
    const bool is_first = std::string_view{name()}.ends_with("[0]");
    const SeenRectangle at = is_first ? box_in(of->number) : resting_ball;
    Sights all{};
    Sight& one = all.sights[1];
    one.kind = is_first ? SightKind::box : SightKind::ball;
    one.number = is_first ? std::uint16_t{7} : std::uint16_t{8};
    one.left = at.left;
    one.top = at.top;
    one.width = at.width;
    one.height = at.height;
    one.score = is_first ? 2 : 1;
    one.confirmed = is_first;
    one.position = {0.4, is_first ? -0.3 : 0.3};
    one.angle = 0.5;
    sights.publish(all, of.sampled_at());
  }
};

}  // namespace flexrf::user
