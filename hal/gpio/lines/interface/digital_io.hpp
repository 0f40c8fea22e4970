// DigitalIo: a digital line, an input or an output.
#pragma once

#include <optional>

#include "digital_io_interface.hpp"
#include "types/digital_edge.hpp"
#include "types/digital_state.hpp"

namespace flexrf {

/// Everything: the thread the line lives in.
class DigitalIo : public DigitalIoInterface {
 public:
  /// What the line is as of this cycle, bounces left out; an output: what it was told. Nothing while its chip
  /// is away [digital-io-1].
  virtual std::optional<DigitalState> state() const noexcept = 0;

  /// The next change of an input, oldest first, bounces too [digital-io-2]. With the queue `edges` connected
  /// they go there instead.
  virtual std::optional<DigitalEdge> read_edge() noexcept = 0;

  /// What an output shall be, from the end of the cycle until the next command [digital-io-3]. Without effect
  /// while is_inhibited() (unless configured as a signal) [digital-io-4] or while its chip is away, and not
  /// remembered.
  virtual void command(bool on) noexcept = 0;
};

}  // namespace flexrf
