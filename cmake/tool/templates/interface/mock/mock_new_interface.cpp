#include "hal/new_interface/mock/mock_new_interface.hpp"

namespace flexrf {

Status MockNewInterface::initialise() {
  feedback = {};
  on_ = commanded_ = false;
  return {};
}

void MockNewInterface::take_in(const Tick& /*tick*/) noexcept {
  feedback.on = on_;
}

void MockNewInterface::act(const Tick& /*tick*/) noexcept {
  switch_to(commanded_);
}

void MockNewInterface::rest(const Tick& /*tick*/) noexcept {
  switch_to(false);
}

bool MockNewInterface::become_safe() noexcept {
  commanded_ = false;
  switch_to(false);
  return true;
}

void MockNewInterface::switch_to(bool on) noexcept {
  if (on != on_) ++feedback.switched;
  on_ = on;
}

}  // namespace flexrf
