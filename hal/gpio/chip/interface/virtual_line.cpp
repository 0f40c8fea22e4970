#include "hal/gpio/chip/interface/virtual_line.hpp"

namespace flexrf {

void VirtualLine::configure(const GpioLineSettings& settings,
                            const std::atomic<bool>& chip_present) noexcept {
  settings_ = settings;
  chip_present_ = &chip_present;
  present_ = false;
  edges_count_ = 0;
}

void VirtualLine::wire(const VirtualLine& source, Duration delay) noexcept {
  source_ = &source;
  wire_delay_ = delay;
}

void VirtualLine::bounce(Duration duration, std::uint64_t seed) noexcept {
  bounce_ = duration;
  random_ = seed;
}

void VirtualLine::drive(bool high) noexcept {
  const std::uint32_t now = changes_.load(std::memory_order_relaxed);
  if (((now & 1U) != 0) != high) changes_.store(now + 1, std::memory_order_release);
}

bool VirtualLine::schedule(Time at, bool high) noexcept {
  if (scheduled_count_ == schedule_capacity) return false;
  scheduled_[(scheduled_first_ + scheduled_count_++) % schedule_capacity] = {high, at};
  return true;
}

void VirtualLine::receive(Time now) noexcept {
  const bool was_present = present_;
  present_ = chip_present_ != nullptr && chip_present_->load(std::memory_order_acquire);
  if (settings_.direction == LineDirection::output) {
    if (present_ && !was_present) output_on_ = settings_.initially_on;
    high_.store(present_ && output_on_ != settings_.active_low, std::memory_order_release);
    return;
  }
  if (!was_present) {
    // What happened before anybody looked is no edge.
    taken_ = changes_.load(std::memory_order_acquire);
    high_.store((taken_ & 1U) != 0, std::memory_order_release);
    wired_ = false;
  }
  const bool follows = source_ != nullptr && source_->is_high() && (wired_ || !blocked_);
  if (follows != wired_) {
    wired_ = follows;
    schedule(now + wire_delay_, wired_);
  }
  take_scheduled(now);
  take_driven(now);
}

void VirtualLine::take_scheduled(Time now) noexcept {
  while (scheduled_count_ > 0 && scheduled_[scheduled_first_].at <= now) {
    const GpioEdge next = scheduled_[scheduled_first_];
    scheduled_first_ = (scheduled_first_ + 1) % schedule_capacity;
    --scheduled_count_;
    change(next.on, next.at);
  }
}

void VirtualLine::take_driven(Time now) noexcept {
  const std::uint32_t changes = changes_.load(std::memory_order_acquire);
  if (changes == taken_) return;
  // More than the kernel would keep are not told one by one.
  if (changes - taken_ > edges_.size()) taken_ = changes - static_cast<std::uint32_t>(edges_.size());
  for (; taken_ != changes; ++taken_) change(((taken_ + 1) & 1U) != 0, now);
  bounce_back((changes & 1U) != 0, now);
}

/// Opens and closes twice more, at times drawn from the seed (splitmix64).
void VirtualLine::bounce_back(bool high, Time at) noexcept {
  if (bounce_ <= Duration{} || scheduled_count_ > 0) return;
  constexpr int reversals = 4;
  for (int i = 1; i <= reversals; ++i) {
    random_ += 0x9e3779b97f4a7c15U;
    std::uint64_t drawn = random_;
    drawn = (drawn ^ (drawn >> 30U)) * 0xbf58476d1ce4e5b9U;
    drawn = (drawn ^ (drawn >> 27U)) * 0x94d049bb133111ebU;
    const Duration share = bounce_ / reversals;
    const auto within =
        static_cast<Duration::rep>((drawn >> 33U) % static_cast<std::uint64_t>(share.count() + 1));
    schedule(at + share * (i - 1) + Duration{within}, i % 2 == 0 ? high : !high);
  }
}

void VirtualLine::change(bool high, Time at) noexcept {
  if (high_.load(std::memory_order_relaxed) == high) return;
  high_.store(high, std::memory_order_release);
  if (!present_ || edges_count_ == edges_.size()) return;
  edges_[(edges_first_ + edges_count_++) % edges_.size()] = {on(high), at};
}

std::optional<bool> VirtualLine::level() const noexcept {
  if (!present_) return std::nullopt;
  return settings_.direction == LineDirection::output ? output_on_
                                                      : on(high_.load(std::memory_order_relaxed));
}

std::optional<GpioEdge> VirtualLine::next_edge() noexcept {
  if (!present_ || edges_count_ == 0) return std::nullopt;
  const GpioEdge edge = edges_[edges_first_];
  edges_first_ = (edges_first_ + 1) % edges_.size();
  --edges_count_;
  return edge;
}

bool VirtualLine::set(bool on) noexcept {
  if (!present_ || jammed_.load(std::memory_order_acquire)) return false;
  output_on_ = on;
  high_.store(on != settings_.active_low, std::memory_order_release);
  return true;
}

Time VirtualLine::next_event() const noexcept {
  return scheduled_count_ == 0 ? Time::max() : scheduled_[scheduled_first_].at;
}

}  // namespace flexrf
