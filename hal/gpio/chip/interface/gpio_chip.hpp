// GpioChip: a chip whose lines are digital inputs and outputs. A bus: devices on it ask for lines by name.
#pragma once

#include <optional>

#include "gpio_chip_interface.hpp"
#include "types/line_bias.hpp"
#include "types/line_direction.hpp"

namespace flexrf {

struct GpioLineSettings {
  const char* name = "";  ///< as the chip calls the line
  LineDirection direction = LineDirection::input;
  LineBias bias = LineBias::as_is;
  bool active_low = false;    ///< on is 0 V, everywhere below [gpio-chip-1]
  bool initially_on = false;  ///< an output: from when it is ours
};

struct GpioEdge {
  bool on = false;
  Time at{};  ///< when the line changed, as the kernel saw it
};

/// One line that a device asked for. Everything: the thread of that device, never blocking, never allocating.
class GpioLine {
 public:
  /// Once in each cycle, before anything else: takes in what the line is now, and notices a chip that went
  /// away or came back.
  virtual void receive(Time now) noexcept = 0;
  /// As of receive(); nothing while the chip is away [gpio-chip-2].
  virtual std::optional<bool> level() const noexcept = 0;
  /// The next change of an input, oldest first. What came and went between two cycles is two
  /// edges [gpio-chip-3].
  virtual std::optional<GpioEdge> next_edge() noexcept = 0;
  /// An output. False: it is as it was, as the chip did not take it or is away. After it came back the line
  /// is as `initially_on` says [gpio-chip-4].
  virtual bool set(bool on) noexcept = 0;
  /// What was set last is at the terminal, as far as the chip can know [gpio-chip-7]. A chip that has to ask
  /// for that does so while it is asked here, once in each cycle.
  virtual bool is_set() noexcept { return true; }
  /// Readable when an edge has come; −1: none, or away.
  virtual int descriptor() const noexcept { return -1; }
  /// In virtual time: when the next edge will come, as far as known [gpio-chip-6].
  virtual Time next_event() const noexcept { return Time::max(); }

 protected:
  ~GpioLine() = default;
};

class GpioChip : public GpioChipInterface {
 public:
  using GpioChipInterface::GpioChipInterface;

  /// From initialise() of the device that will use the line; valid until release(). Fails with a cause for
  /// the operator: no such line, in use by somebody else, no permission, no chip [gpio-chip-5]. Of a chip
  /// that is switched on by itself, as a module on a bus, the line is away until it is there. Lifecycle
  /// thread.
  virtual Result<GpioLine*> request(const GpioLineSettings& settings) = 0;
  /// From its stop(). Lifecycle thread.
  virtual void release(GpioLine* line) noexcept = 0;
};

}  // namespace flexrf
