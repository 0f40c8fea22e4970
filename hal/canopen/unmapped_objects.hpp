// What a drive has in no PDO and is told and asked by SDO while it is operational: its mode, its profile
// velocity.
#pragma once

#include <optional>

#include "hal/canopen/cia402.hpp"
#include "hal/canopen/node.hpp"

namespace flexrf::canopen::cia402 {

/// Objects 6060 and 6061, and 6081: one request at a time, and only until the drive shows the mode that it
/// was told, and has answered that it took the velocity. One thread; never blocks, never allocates.
class UnmappedObjects {
 public:
  struct Wanted {
    std::optional<Mode> mode{};            ///< nothing: it is in PDOs
    std::optional<std::uint32_t> speed{};  ///< as the drive counts it; nothing: likewise, or not told
  };

  /// What the drive was told before is gone, as after a reset.
  void forget() noexcept { *this = UnmappedObjects{}; }
  /// Once for each cycle in which the node is operational. What the drive refused, once; else ok. What is
  /// refused is not asked for again before something else is; what is not answered is.
  Status advance(const Wanted& wanted, Node& node, Time now, Outbox& outbox) noexcept;
  /// As it was read last.
  Mode shown_mode() const noexcept { return shown_; }
  /// It has answered that it took this one, and was told no other since.
  bool has_speed(std::uint32_t speed) const noexcept { return told_speed_ == speed; }

 private:
  enum class Asked : std::uint8_t { nothing, write_mode, read_mode, write_speed };

  Status take_answer(const SdoClient& client) noexcept;
  bool ask_for_mode(Mode wanted, SdoClient& client, Time now, Outbox& outbox) noexcept;
  void ask_for_speed(std::uint32_t wanted, SdoClient& client, Time now, Outbox& outbox) noexcept;

  Asked asked_ = Asked::nothing;
  Mode asked_mode_ = Mode::none;
  std::optional<Mode> told_mode_;
  std::optional<Mode> refused_mode_;
  Mode shown_ = Mode::none;
  std::uint32_t asked_speed_ = 0;
  std::optional<std::uint32_t> told_speed_;
  std::optional<std::uint32_t> refused_speed_;
};

}  // namespace flexrf::canopen::cia402
