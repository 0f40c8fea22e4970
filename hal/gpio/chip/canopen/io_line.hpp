// A line of a CANopen module.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "hal/gpio/chip/interface/gpio_chip.hpp"

namespace flexrf {

/// The lines of a module as of this cycle, and what its outputs are to be told at its end: bits, the first
/// line is the lowest. Nothing: the module is away, or has not told its inputs.
struct IoImage {
  std::optional<std::uint64_t> inputs{};
  std::optional<std::uint64_t> outputs{};
  bool asks = false;           ///< somebody wants to know whether the module has its outputs
  bool are_confirmed = false;  ///< it has answered that it has them
};

/// Its chip, and the device that asked for it, live in one thread.
class IoLine final : public GpioLine {
 public:
  /// Once, before all else. `bit`: its place in the image, which outlives the line.
  void place(IoImage& image, LineDirection direction, unsigned bit) noexcept {
    image_ = &image;
    direction_ = direction;
    bit_ = std::uint64_t{1} << bit;
  }
  std::uint64_t bit() const noexcept { return bit_; }
  bool is_output() const noexcept { return direction_ == LineDirection::output; }

  /// The lifecycle thread, while no device has it.
  void configure(bool active_low) noexcept {
    active_low_ = active_low;
    is_new_ = true;
  }

  /// The chip's, before the line's device receives: an input has changed. The newest are lost.
  void change(bool high, Time at) noexcept {
    if (count_ == changes_.size()) return;
    changes_[(first_ + count_++) % changes_.size()] = {high, at};
  }

  // ---- GpioLine

  void receive(Time now) noexcept override;
  std::optional<bool> level() const noexcept override { return level_; }
  std::optional<GpioEdge> next_edge() noexcept override;
  bool set(bool on) noexcept override;
  bool is_set() noexcept override {
    image_->asks = true;
    return image_->are_confirmed;
  }

 private:
  IoImage* image_ = nullptr;
  LineDirection direction_ = LineDirection::input;
  std::uint64_t bit_ = 0;
  bool active_low_ = false;
  bool is_new_ = false;  // nobody had it until now: what was before is nobody's
  std::optional<bool> level_;
  std::array<GpioEdge, 16> changes_{};  // as they were at the terminal; as many as the kernel keeps of a line
  std::size_t first_ = 0;
  std::size_t count_ = 0;
};

}  // namespace flexrf
