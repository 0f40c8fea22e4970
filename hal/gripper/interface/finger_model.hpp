// FingerModel: fingers that exist in memory only, for mock and simulated grippers and for tests.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>

#include "base/time.hpp"

namespace flexrf {

/// Two fingers and what is between them; widths in m. One thread.
class FingerModel {
 public:
  enum class Outcome : std::uint8_t { moves, arrived, stopped_closing, stopped_opening };

  FingerModel(double closed_width, double open_width) noexcept
      : closed_(closed_width), open_(open_width), opening_(open_width) {}

  double opening() const noexcept { return opening_; }
  void set_opening(double opening) noexcept { opening_ = std::clamp(opening, closed_, open_); }

  /// An object between the fingers, so wide. Where they are closer already it does not fit, and they move
  /// apart.
  void put_object(double width) noexcept {
    object_ = width;
    opening_ = std::max(opening_, std::min(width, open_));
  }
  /// A hollow object around the fingers, with so much room for them.
  void put_around(double room) noexcept {
    room_ = room;
    opening_ = std::min(opening_, std::max(room, closed_));
  }
  void take_away() noexcept {
    object_.reset();
    room_.reset();
  }
  /// Whatever drives them, they do not move.
  void set_stuck(bool on) noexcept { stuck_ = on; }

  /// Driven towards `target` for a time.
  Outcome move(double target, double speed, Duration elapsed) noexcept {
    const double goal = std::clamp(target, closed_, open_);
    if (stuck_ && goal != opening_) return Outcome::moves;
    const double step = speed * seconds(elapsed);
    const double wanted = std::clamp(goal, opening_ - step, opening_ + step);
    const double least = object_ ? std::min(*object_, open_) : closed_;
    const double most = room_ ? std::max(*room_, closed_) : open_;
    opening_ = std::clamp(wanted, std::min(least, opening_), std::max(most, opening_));
    if (opening_ == goal) return Outcome::arrived;
    if (goal < opening_ && opening_ <= least) return Outcome::stopped_closing;
    if (goal > opening_ && opening_ >= most) return Outcome::stopped_opening;
    return Outcome::moves;
  }

 private:
  double closed_;
  double open_;
  double opening_;
  std::optional<double> object_;
  std::optional<double> room_;
  bool stuck_ = false;
};

/// As a scene tells it in each cycle: what is between the fingers stops them at this width; 0: nothing does.
inline void meet_width(FingerModel& fingers, double width) noexcept {
  if (width > 0) {
    fingers.put_object(width);
  } else {
    fingers.take_away();
  }
}

}  // namespace flexrf
