#pragma once

#include "axle_interface.hpp"

namespace flexrf::user {

class Axle : public AxleInterface {
 public:
  virtual void command(double speed) noexcept = 0;  ///< rad/s
  virtual double speed() const noexcept = 0;        ///< rad/s
};

}  // namespace flexrf::user
