// The mode of a drive that has it in no PDO: told and read by SDO.
#pragma once

#include <optional>

#include "hal/canopen/cia402.hpp"
#include "hal/canopen/node.hpp"

namespace flexrf::canopen::cia402 {

/// Objects 6060 and 6061, one request at a time, and only until the drive shows the mode that it was told.
/// One thread; never blocks, never allocates.
class ModeBySdo {
 public:
  /// What the drive was told before is gone, as after a reset.
  void forget() noexcept { *this = ModeBySdo{}; }
  /// Once for each cycle in which the node is operational. What the drive refused, once; else ok. What is
  /// refused is not asked for again before another mode is; what is not answered is.
  Status advance(Mode wanted, Node& node, Time now, Outbox& outbox) noexcept;
  /// As it was read last.
  Mode shown() const noexcept { return shown_; }

 private:
  enum class Asked : std::uint8_t { nothing, write, read };

  Status take_answer(const SdoClient& client) noexcept;

  Asked asked_ = Asked::nothing;
  Mode asked_for_ = Mode::none;
  std::optional<Mode> told_;
  std::optional<Mode> refused_;
  Mode shown_ = Mode::none;
};

}  // namespace flexrf::canopen::cia402
