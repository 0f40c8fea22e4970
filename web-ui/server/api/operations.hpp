// Everything that clients can ask for, by REST and live alike.
#pragma once

#include <optional>
#include <string_view>

#include "web-ui/server/api/edit_operations.hpp"
#include "web-ui/server/api/lifecycle_operations.hpp"
#include "web-ui/server/api/motion_operations.hpp"
#include "web-ui/server/api/parameter_operations.hpp"
#include "web-ui/server/api/save_operations.hpp"
#include "web-ui/server/api/subscriptions.hpp"

namespace flexrf::panel {

struct Operations {
  const Directory& directory;
  Answers& answers;
  ParameterOperations& parameters;
  MotionOperations& motion;
  EditOperations& edits;
  LifecycleOperations& lifecycle;
  SaveOperations& saving;
  Subscriptions& subscriptions;

  /// None: who asks is refused, and told which name may have been meant.
  std::optional<ComponentIndex> component(const Caller& caller, std::string_view name);
  /// start, stop, initialise, activate, retire, clone (of the member `source`).
  void act(const Caller& caller, ComponentIndex component, std::string_view action, std::string_view source,
           Time now);
};

/// One thing that is asked for, and whom to answer.
struct Asked {
  Operations& operations;
  const Caller& caller;
  Fields& fields;
  std::string_view what;  ///< as the refusal of a field begins: "set", "The body"
  Time now;
  // What a path of REST says; none: a field does.
  std::optional<std::string_view> component{};
  std::optional<std::string_view> action{};

  /// False: the first of the fields that is wrong was answered.
  bool is_right();
  /// None: that was answered.
  std::optional<ComponentIndex> find_component();
};

struct Operation {
  std::string_view name;
  /// Reads its fields, and refuses or does what is asked for. The server's thread.
  void (*run)(Asked& asked);
  bool is_an_act = true;  ///< of a person; not what a page does by itself
};

/// By its name, as docs/panel-protocol.md lists them ("op"); null: there is none.
const Operation* find_operation(std::string_view name) noexcept;
/// Names the one that may have been meant.
Refusal no_operation(std::string_view name) noexcept;

}  // namespace flexrf::panel
