#pragma once

#include "mover_interface.hpp"

namespace flexrf::user {

class Mover : public MoverInterface {
 public:
  virtual void go(double x) noexcept = 0;
};

}  // namespace flexrf::user
