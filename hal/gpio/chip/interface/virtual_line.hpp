// VirtualLine: a line that exists in memory only, for the chips of tests and simulations.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

#include "hal/gpio/chip/interface/gpio_chip.hpp"

namespace flexrf {

/// Levels are physical where they are called high, and logical (active-low applied) where they are called on.
class VirtualLine final : public GpioLine {
 public:
  /// Changes that wait for their times; a schedule that is full takes no more.
  static constexpr std::size_t schedule_capacity = 64;

  // ---- the chip's: lifecycle thread

  void configure(const GpioLineSettings& settings, const std::atomic<bool>& chip_present) noexcept;
  /// An input follows this output (physical levels), `delay` later.
  void wire(const VirtualLine& source, Duration delay) noexcept;
  /// While it is on, an input that is low stays so, whatever its wire says: what would close the contact does
  /// not come that far.
  void block(bool on) noexcept { blocked_ = on; }
  /// Whenever drive() changes the level, the contact opens and closes a few times within `duration`.
  void bounce(Duration duration, std::uint64_t seed) noexcept;

  // ---- the far end's: any one thread

  /// Drives an input from the next cycle on. Each change is an edge, also those between two cycles.
  void drive(bool high) noexcept;
  /// What an output drives; an input: what is seen of it.
  bool is_high() const noexcept { return high_.load(std::memory_order_acquire); }
  /// An output takes no value from now on, and stays as it is.
  void jam(bool on) noexcept { jammed_.store(on, std::memory_order_release); }

  // ---- the far end's, in the line's own thread or before it runs

  /// An edge to come, at its own time. In order. False: no room.
  bool schedule(Time at, bool high) noexcept;

  // ---- GpioLine

  void receive(Time now) noexcept override;
  std::optional<bool> level() const noexcept override;
  std::optional<GpioEdge> next_edge() noexcept override;
  bool set(bool on) noexcept override;
  Time next_event() const noexcept override;

 private:
  void take_scheduled(Time now) noexcept;
  void take_driven(Time now) noexcept;
  void change(bool high, Time at) noexcept;
  void bounce_back(bool high, Time at) noexcept;
  bool on(bool high) const noexcept { return high != settings_.active_low; }

  GpioLineSettings settings_;
  const std::atomic<bool>* chip_present_ = nullptr;
  std::atomic<std::uint32_t> changes_{0};  // by drive(); bit 0 is the level
  std::atomic<bool> high_{false};
  std::atomic<bool> jammed_{false};
  std::uint32_t taken_ = 0;  // of the changes
  const VirtualLine* source_ = nullptr;
  Duration wire_delay_{};
  bool wired_ = false;
  bool blocked_ = false;
  Duration bounce_{};
  std::uint64_t random_ = 1;
  bool present_ = false;
  bool output_on_ = false;
  std::array<GpioEdge, schedule_capacity> scheduled_{};  // physical
  std::size_t scheduled_first_ = 0;
  std::size_t scheduled_count_ = 0;
  std::array<GpioEdge, 16> edges_{};  // as many as the kernel keeps; the newest are lost
  std::size_t edges_first_ = 0;
  std::size_t edges_count_ = 0;
};

}  // namespace flexrf
