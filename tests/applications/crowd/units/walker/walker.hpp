#pragma once

#include "walker_unit.hpp"

namespace flexrf::user {

class Walker final : public WalkerUnit {
 public:
  Status initialise() override {
    if (configuration.stride == 13) return Status::error(StatusCode::internal, "a stride of 13 is unlucky");
    reset();
    return {};
  }
  void reset() noexcept override { number_ = 0; }
  void step(const Tick& /*tick*/) override {
    number_ += configuration.stride;
    mark.publish(
        {number_, runtime.gain, configuration.stride, number_ + runtime.gain + configuration.stride});
  }

 private:
  std::uint64_t number_ = 0;
};

}  // namespace flexrf::user
