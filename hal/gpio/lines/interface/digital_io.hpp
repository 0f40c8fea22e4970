// DigitalIo: a digital line, an input or an output.
#pragma once

#include <optional>

#include "digital_io_interface.hpp"
#include "hal/driver/actuator.hpp"
#include "types/digital_edge.hpp"
#include "types/digital_state.hpp"

namespace flexrf {

/// Everything: the thread the line lives in. make_safe() sets an output to its safe value at once
/// [digital-io-5], and is true once the chip knows that the output has it. While the chip is away it is
/// false [digital-io-9].
class DigitalIo : public Actuator<DigitalIoInterface> {
 public:
  using Actuator::Actuator;

  /// What the line is as of this cycle, bounces left out; an output: what it was told. Nothing while its chip
  /// is away [digital-io-1].
  virtual std::optional<DigitalState> state() const noexcept = 0;

  /// The next change of an input, oldest first, bounces too [digital-io-2]. With the queue `edges` connected
  /// they go there instead [digital-io-6]. What it has no room for waits, and is not forgotten when no other
  /// change comes [digital-io-8].
  virtual std::optional<DigitalEdge> read_edge() noexcept = 0;

  /// What an output shall be, from the end of the cycle until the next command [digital-io-3]. Without effect
  /// while is_inhibited() (unless configured as a signal) [digital-io-4] or while its chip is away, and not
  /// remembered [digital-io-7].
  void command(bool on) noexcept {
    if (may_act() || is_signal()) set(on);
  }

 private:
  /// It is configured as a signal: an output that moves nothing, such as a lamp, and says what is so also
  /// while nothing may move.
  virtual bool is_signal() const noexcept = 0;
  /// A command that is taken.
  virtual void set(bool on) noexcept = 0;
  /// What was commanded and has not left is given up.
  virtual void drop() noexcept = 0;
  /// The end of the cycle: what was commanded leaves.
  virtual void drive(const Tick& tick) noexcept = 0;

  void forget() noexcept final {
    if (!is_signal()) drop();
  }
  void act(const Tick& tick) noexcept final { drive(tick); }
  void rest(const Tick& tick) noexcept final { drive(tick); }
};

}  // namespace flexrf
