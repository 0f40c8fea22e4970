#include "web-ui/server/api/motion_operations.hpp"

namespace flexrf::panel {

void MotionOperations::stop_motion(const Caller& caller) {
  if (!permission_->has_role(caller, Role::viewer, "stop motion")) return;
  executive_->cell().stop_motion(permission_->who(caller));
  parameters_->forget_holds();
  answers_->done(caller);
}

void MotionOperations::clear_stop_motion(const Caller& caller) {
  if (!permission_->may_control(caller, Role::operator_, "clear Stop motion")) return;
  executive_->cell().clear_stop_motion(permission_->who(caller));
  answers_->done(caller);
}

void MotionOperations::start_motion(const Caller& caller) {
  if (!permission_->may_control(caller, Role::operator_, "start motion")) return;
  if (edits_->is_open()) {
    return answers_->refuse(caller, RefusalKind::wrong_state,
                            "The configuration is being edited; apply or discard the edit before Start.");
  }
  if (const Status status = executive_->cell().start_motion(permission_->who(caller)); !status)
    return answers_->refuse(caller, RefusalKind::wrong_state, "No Start: %s.", status.cause());
  answers_->done(caller);
}

void MotionOperations::take_control(const Caller& caller, Time now) {
  switch (access_->take(caller.session, now)) {
    case AccessControl::Taking::taken:
    case AccessControl::Taking::asked:
      if (access_->holder() != caller.session)
        executive_->cell().audit().note(permission_->who(caller), "asked for control");
      return answers_->done(caller, [this, &caller](JsonWriter& json) {
        json.member("taken", access_->holder() == caller.session);
      });
    case AccessControl::Taking::refused_role:
      return answers_->refuse(caller, RefusalKind::role_missing,
                              "The control token needs the role operator; log in as one.");
    case AccessControl::Taking::refused_asked:
      return answers_->refuse(caller, RefusalKind::wrong_state,
                              "Somebody else has asked for control already; wait until that "
                              "is answered.");
    case AccessControl::Taking::refused_local:
      break;
  }
  answers_->refuse(caller, RefusalKind::control_missing,
                   "Control is held at the machine, and is not given away from afar; ask "
                   "the person there to release it.");
}

void MotionOperations::release_control(const Caller& caller) {
  access_->release(caller.session);
  answers_->done(caller);
}

void MotionOperations::answer_control(const Caller& caller, bool grant, Time now) {
  if (access_->answer(caller.session, grant, now)) {
    if (!grant) executive_->cell().audit().note(permission_->who(caller), "kept control");
    return answers_->done(caller);
  }
  answers_->refuse(caller, RefusalKind::wrong_state,
                   "There is nothing to answer: you do not hold control, or nobody asks.");
}

}  // namespace flexrf::panel
