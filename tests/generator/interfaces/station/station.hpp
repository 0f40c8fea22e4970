#pragma once

#include "station_interface.hpp"

namespace flexrf {

class Station : public StationInterface {
 public:
  virtual double output() const noexcept = 0;
};

}  // namespace flexrf
