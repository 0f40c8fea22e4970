// The object dictionary of a simulated CiA 401 module.
#pragma once

#include "hal/canopen/simulated_objects.hpp"

namespace flexrf {

class ModuleObjects final : public canopen::SimulatedObjects {
 public:
  /// As a reset of the node finds them: its PDOs are mapped and in use as CiA 401 has it, changes of inputs
  /// are not told before somebody enables that (object 6005).
  ModuleObjects(std::uint8_t node, std::uint8_t input_bytes, std::uint8_t output_bytes);

  /// On purpose: it has none of the objects with this index.
  void lack_all(std::uint16_t index);
};

}  // namespace flexrf
