#include "hal/new_interface/mock/mock_new_interface.hpp"

namespace flexrf {

Status MockNewInterface::initialise() {
  feedback = {};
  on_ = commanded_ = false;
  return {};
}

void MockNewInterface::receive(const Tick& /*tick*/) noexcept {
  feedback.on = on_;
}

void MockNewInterface::send(const Tick& /*tick*/) noexcept {
  if (is_inhibited() || !fault().is_ok()) commanded_ = false;
  switch_to(commanded_);
}

bool MockNewInterface::make_safe() noexcept {
  commanded_ = false;
  switch_to(false);
  return true;
}

void MockNewInterface::command(bool on) noexcept {
  if (!is_inhibited()) commanded_ = on;
}

void MockNewInterface::switch_to(bool on) noexcept {
  if (on != on_) ++feedback.switched;
  on_ = on;
}

}  // namespace flexrf
