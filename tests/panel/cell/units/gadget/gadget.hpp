#pragma once

#include <cstdint>

#include "gadget_unit.hpp"

namespace flexrf::user {

class Gadget final : public GadgetUnit {
 public:
  Status initialise() override;
  Status accept(const Runtime& proposed) override;
  void step(const Tick& tick) override;

 private:
  double size_ = 0;
  std::uint32_t initialised_ = 0;
};

}  // namespace flexrf::user
