// Gantry: moves two axes together, and lets them find their homes.
//
// It makes the profile and commands a position in each cycle; the drives follow. What it is told are orders
// with numbers: each is taken up once, so that one from before a stop is not followed after it.
#pragma once

#include <optional>

#include "gantry_unit.hpp"
#include "units/gantry/gantry_path.hpp"

namespace flexrf::user {

class Gantry final : public GantryUnit {
 public:
  Status initialise() override;
  void step(const Tick& tick) override;
  bool is_idle() const noexcept override { return phase_ == Phase::resting; }

 private:
  enum class Phase : std::uint8_t {
    resting,
    moving,
    settling,      ///< the set-point is there, the axes not yet
    braking,       ///< an order or a stop ends the motion
    homing_first,  ///< the vertical axis
    homing_second,
    homing_ends,  ///< was stopped: until the drives say that it is over
  };

  bool may_follow(const Tick& tick) noexcept;
  void take_up_order(const Tick& tick) noexcept;
  void begin(const GantryOrder& wanted) noexcept;
  void brake() noexcept;
  void go_on(const Tick& tick) noexcept;
  void home_on() noexcept;
  void settle(Time now) noexcept;
  void end(GantryOutcome outcome, const Status& cause = {}) noexcept;
  void seed_from_drives() noexcept;
  double elapsed_in(const Tick& tick) noexcept;
  void command() noexcept;
  void publish(const Tick& tick) noexcept;

  std::optional<ServoState> x_state_;
  std::optional<ServoState> z_state_;
  Phase phase_ = Phase::resting;
  GantryPath path_;
  GantryOrder taken_{};
  GantryOutcome outcome_ = GantryOutcome::none;
  Status trouble_;    // of the last order
  Status hindrance_;  // why it cannot follow at all
  Time settles_since_{};
  Time last_cycle_{};
  bool followed_ = false;  // in the cycle before
};

}  // namespace flexrf::user
