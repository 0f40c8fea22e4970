// LineDriver: a driver of DigitalIo over a generated base. What differs between drivers is the chip they are
// on.
#pragma once

#include <algorithm>

#include "base/text.hpp"
#include "hal/gpio/lines/interface/digital_line.hpp"

namespace flexrf {

template <class Base>
class LineDriver : public Base {
 public:
  Status initialise() override {
    const auto& set = this->configuration;
    return line_.open(*this->bus, {.name = text_view(set.line),
                                   .direction = set.direction,
                                   .bias = set.bias,
                                   .active_low = set.active_low,
                                   .debounce = duration_of(set.debounce),
                                   .emergency_stop = set.emergency_stop,
                                   .safe_value = set.safe_value});
  }
  void stop() override {
    line_.close();
    retry_at_ = Time::max();
  }

  bool guards_motion() const noexcept override { return this->configuration.emergency_stop; }
  bool demands_safe_state() const noexcept override { return line_.demands_safe_state(); }
  int descriptor() const noexcept override { return line_.descriptor(); }
  Time next_event() const noexcept override { return std::min(line_.next_event(), retry_at_); }

  std::optional<DigitalState> state() const noexcept override { return line_.state(); }
  std::optional<DigitalEdge> read_edge() noexcept override { return line_.read_edge(); }

 private:
  /// How soon it asks to be called again for edges that the queue had no room for: nothing else may come.
  static constexpr Duration retry_interval = std::chrono::milliseconds(5);

  void take_in(const Tick& tick) noexcept override {
    line_.receive(tick.now);
    if (const auto now = line_.state()) this->level.publish(*now);
    while (this->edges.is_connected() && this->edges.has_room()) {
      const std::optional<DigitalEdge> edge = line_.read_edge();
      if (!edge) break;
      this->edges.push(*edge, Time{Duration{edge->at}});
    }
    retry_at_ = this->edges.is_connected() && line_.has_edges() ? tick.now + retry_interval : Time::max();
    line_.fill(this->feedback);
  }
  bool is_signal() const noexcept override { return this->configuration.signal; }
  void set(bool on) noexcept override { line_.command(on); }
  void drop() noexcept override { line_.forget(); }
  void drive(const Tick& tick) noexcept override {
    line_.send(tick.now);
    line_.fill(this->feedback);
  }
  bool become_safe() noexcept override { return line_.make_safe(); }

  DigitalLine line_;
  Time retry_at_ = Time::max();
};

}  // namespace flexrf
