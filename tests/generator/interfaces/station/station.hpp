#pragma once

#include "station_interface.hpp"

namespace flexrf::user {

class Station : public StationInterface {
 public:
  virtual double output() const noexcept = 0;
};

}  // namespace flexrf::user
