#include "hal/gpio/chip/canopen/io_line.hpp"

namespace flexrf {

void IoLine::receive(Time /*now*/) noexcept {
  const std::optional<std::uint64_t>& lines = is_output() ? image_->outputs : image_->inputs;
  if (is_new_ || !lines) count_ = 0;
  is_new_ = false;
  level_.reset();
  if (lines) level_ = ((*lines & bit_) != 0) != active_low_;
}

std::optional<GpioEdge> IoLine::next_edge() noexcept {
  if (count_ == 0) return std::nullopt;
  const GpioEdge change = changes_[first_];
  first_ = (first_ + 1) % changes_.size();
  --count_;
  return GpioEdge{change.on != active_low_, change.at};
}

bool IoLine::set(bool on) noexcept {
  if (!image_->outputs) return false;
  const bool high = on != active_low_;
  const std::uint64_t before = *image_->outputs;
  *image_->outputs = high ? before | bit_ : before & ~bit_;
  if (*image_->outputs != before) image_->are_confirmed = false;
  return true;
}

}  // namespace flexrf
