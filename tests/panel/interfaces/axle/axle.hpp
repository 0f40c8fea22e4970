#pragma once

#include "axle_interface.hpp"

namespace flexrf {

class Axle : public AxleInterface {
 public:
  virtual void command(double speed) noexcept = 0;  ///< rad/s
  virtual double speed() const noexcept = 0;        ///< rad/s
};

}  // namespace flexrf
