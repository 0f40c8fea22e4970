// Homing in the midst of another mode: to rest, into mode homing, the run, to rest, and back.
#pragma once

#include "hal/canopen/drive_modes.hpp"

namespace flexrf::canopen::cia402 {

/// Whether a drive knows where its axis is.
enum class Homing : std::uint8_t { not_homed, running, failed, homed };

/// What the drive says, as far as a homing goes by it.
struct HomingView {
  std::uint16_t statusword = 0;
  bool is_new = false;  ///< it came since the cycle before
  Mode shown = Mode::none;
  bool at_rest = false;
};

/// One thread; never blocks, never allocates.
class AxisHoming {
 public:
  struct Limits {
    Duration run = std::chrono::seconds(60);
    Duration settle = std::chrono::milliseconds(50);  ///< see HomingRun
    bool tells_reached = true;                        ///< likewise
    Duration mode = std::chrono::milliseconds(500);   ///< until the drive shows another mode
    Duration stop = std::chrono::seconds(5);          ///< until it is at rest
  };

  /// `own`: the axis's mode. `needed` false: its encoder is absolute, it is homed.
  void begin(const Limits& limits, Mode own, bool needed) noexcept;

  /// Without effect when it is not needed, or is running. Whoever leads the axis halts it.
  void start() noexcept;
  /// It is to come to rest; failed then.
  void halt() noexcept;
  /// Operation is not enabled any more: what was running has failed.
  void interrupt() noexcept;
  /// It was switched off to change its mode, and does not take mode homing: what was running has failed.
  void refuse_mode() noexcept;
  /// The drive was gone: what it knew is forgotten.
  void forget() noexcept;

  /// From start() until the drive is in its own mode again.
  bool is_running() const noexcept { return phase_ != Phase::idle; }
  /// Still in its own mode, on its way to rest.
  bool is_resting() const noexcept { return phase_ == Phase::resting; }
  Homing state() const noexcept;
  /// The drive has found it, and may still be on its way back into its own mode.
  bool knows_home() const noexcept { return homed_; }
  /// Which mode the drive is to be in.
  Mode mode() const noexcept;
  /// Once for each cycle in which operation is enabled and is_running(): the bits to add to the controlword.
  std::uint16_t advance(const HomingView& view, Time now) noexcept;

  /// Why it failed; else ok.
  const Status& problem() const noexcept { return problem_; }
  /// It neither stops nor comes back into its mode: the axis is to be switched off.
  const Status& trouble() const noexcept { return trouble_; }

 private:
  enum class Phase : std::uint8_t { idle, resting, entering, running, stopping, leaving };

  void enter(Phase phase) noexcept;
  void fail(const Status& problem) noexcept;
  static Status mode_refused() noexcept;
  std::uint16_t advance_run(const HomingView& view, Time now) noexcept;

  Limits limits_;
  HomingRun run_{std::chrono::seconds(60), std::chrono::milliseconds(50), true};
  Mode own_ = Mode::cyclic_position;
  bool needed_ = false;
  bool homed_ = false;
  Phase phase_ = Phase::idle;
  std::optional<Time> since_;  // of the phase; nothing: the next advance() is its first
  Status problem_;
  Status trouble_;
};

}  // namespace flexrf::canopen::cia402
