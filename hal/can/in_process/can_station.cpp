#include "hal/can/in_process/can_station.hpp"

#include <algorithm>

namespace flexrf {
namespace {

constexpr unsigned off_above = 255;
constexpr unsigned most_receive_errors = 135;  // a passive receiver counts no further

}  // namespace

void CanStation::reset() noexcept {
  waiting_.clear();
  transmit_errors_ = receive_errors_ = corrupted_ = 0;
  failed_ = sent_ = arbitrations_lost_ = 0;
  connected_ = true;
  off_ = false;
  restart_at_ = Time::max();
  silent_until_ = Time{};
  node_event_ = Time{};
}

void CanStation::count_transmit_error(bool unacknowledged) noexcept {
  ++failed_;
  // A passive node that nobody acknowledges counts no further: alone on the bus, it never leaves it.
  if (unacknowledged && transmit_errors_ > passive_above) return;
  transmit_errors_ += 8;
  if (transmit_errors_ > off_above) {
    off_ = true;
    waiting_.clear();
  }
}

void CanStation::count_receive_error() noexcept {
  receive_errors_ = std::min(receive_errors_ + 1, most_receive_errors);
}

}  // namespace flexrf
