// Stop motion, its clearing, Start; and the control token.
#pragma once

#include "runtime/executive/executive.hpp"
#include "web-ui/server/api/answers.hpp"
#include "web-ui/server/api/edit_operations.hpp"
#include "web-ui/server/api/parameter_operations.hpp"

namespace flexrf::panel {

/// The server's thread.
class MotionOperations {
 public:
  MotionOperations(Executive& executive, AccessControl& access, Answers& answers, Permission& permission,
                   ParameterOperations& parameters, const EditOperations& edits) noexcept
      : executive_(&executive),
        access_(&access),
        answers_(&answers),
        permission_(&permission),
        parameters_(&parameters),
        edits_(&edits) {}

  /// Latched before anything else is looked at; whoever sees the page may.
  void stop_motion(const Caller& caller);
  void clear_stop_motion(const Caller& caller);
  void start_motion(const Caller& caller);

  void take_control(const Caller& caller, Time now);
  void release_control(const Caller& caller);
  void answer_control(const Caller& caller, bool grant, Time now);

 private:
  Executive* executive_;
  AccessControl* access_;
  Answers* answers_;
  Permission* permission_;
  ParameterOperations* parameters_;
  const EditOperations* edits_;
};

}  // namespace flexrf::panel
