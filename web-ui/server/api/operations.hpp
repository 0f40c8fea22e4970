// Everything that clients can ask for, by REST and live alike.
#pragma once

#include "web-ui/server/api/edit_operations.hpp"
#include "web-ui/server/api/lifecycle_operations.hpp"
#include "web-ui/server/api/motion_operations.hpp"
#include "web-ui/server/api/parameter_operations.hpp"
#include "web-ui/server/api/save_operations.hpp"

namespace flexrf::panel {

struct Operations {
  const Directory& directory;
  Answers& answers;
  ParameterOperations& parameters;
  MotionOperations& motion;
  EditOperations& edits;
  LifecycleOperations& lifecycle;
  SaveOperations& saving;

  /// None: who asks is refused, and told which name may have been meant.
  std::optional<ComponentIndex> component(const Caller& caller, std::string_view name);
  /// start, stop, initialise, activate, retire, clone (of the member `source`).
  void act(const Caller& caller, ComponentIndex component, std::string_view action, std::string_view source,
           Time now);
};

}  // namespace flexrf::panel
