// The object dictionary of a simulated CiA 402 drive.
#pragma once

#include "hal/canopen/simulated_objects.hpp"

namespace flexrf {

class DriveObjects final : public canopen::SimulatedObjects {
 public:
  /// As a reset of the node finds them.
  DriveObjects();
};

}  // namespace flexrf
