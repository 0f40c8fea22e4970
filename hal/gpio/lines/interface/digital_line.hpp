// DigitalLine: what every driver of DigitalIo does with the line that its chip gives it.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "hal/gpio/chip/interface/gpio_chip.hpp"
#include "hal/gpio/lines/interface/digital_io.hpp"
#include "hal/gpio/lines/interface/line_filter.hpp"

namespace flexrf {

struct DigitalLineSettings {
  std::string_view name{};
  LineDirection direction = LineDirection::input;
  LineBias bias = LineBias::as_is;
  bool active_low = false;
  Duration debounce{};
  bool emergency_stop = false;
  bool safe_value = false;
};

/// Does what it is told: whether something may move is for its driver to know. open, close: the lifecycle
/// thread. Everything else: the thread of the device.
class DigitalLine {
 public:
  /// Error: it has no name, it is an output and an emergency stop [digital-line-4], or the chip refuses.
  Status open(GpioChip& chip, const DigitalLineSettings& settings);
  void close() noexcept;

  void receive(Time now) noexcept;
  std::optional<DigitalState> state() const noexcept;
  std::optional<DigitalEdge> read_edge() noexcept;
  bool has_edges() const noexcept { return edges_count_ > 0; }
  void command(bool on) noexcept;
  void forget() noexcept { commanded_.reset(); }
  void send(Time now) noexcept;
  bool make_safe() noexcept;
  /// Of an output: its chip knows that it has what it was told. To be asked in each cycle until it is so.
  bool is_set() const noexcept { return present_ && line_->is_set(); }
  /// Of an emergency stop: unless it is there [digital-line-1], was on throughout this cycle
  /// [digital-line-2], and has been for as long as its debouncing asks [digital-line-3].
  bool demands_safe_state() const noexcept { return settings_.emergency_stop && !permits_; }
  int descriptor() const noexcept { return line_ == nullptr ? -1 : line_->descriptor(); }
  Time next_event() const noexcept;
  void fill(DigitalIoFeedback& feedback) const noexcept;

 private:
  bool is_output() const noexcept { return settings_.direction == LineDirection::output; }
  void come_back(bool level, Time now) noexcept;
  bool take_edges() noexcept;
  void keep(const DigitalEdge& edge) noexcept;

  DigitalLineSettings settings_;
  std::array<char, 33> name_{};
  GpioChip* chip_ = nullptr;
  GpioLine* line_ = nullptr;
  LineFilter filter_;
  bool present_ = false;
  bool permits_ = false;
  bool went_off_ = false;  // in this cycle
  std::optional<bool> last_edge_;
  std::array<DigitalEdge, 64> edges_{};
  std::size_t edges_first_ = 0;
  std::size_t edges_count_ = 0;
  std::uint64_t seen_ = 0;
  std::uint64_t missed_ = 0;
  std::uint64_t dropped_ = 0;
  // An output's.
  bool on_ = false;
  Time since_{};
  std::optional<bool> commanded_;
};

}  // namespace flexrf
