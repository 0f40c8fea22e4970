#include "web-ui/server/api/save_operations.hpp"

namespace flexrf::panel {

void SaveOperations::save(const Caller& caller, Time now) {
  if (!permission_->may_control(caller, Role::operator_, "save the values")) return;
  if (waiting_.is_full()) return answers_->refuse(caller, saving_already());
  const Result<std::uint64_t> number = executive_->saver().request();
  if (!number) return answers_->refuse(caller, not_saved(RefusalKind::wrong_state, number.status()));
  waiting_.add({caller, *number, now + patience});
}

void SaveOperations::tick(Time now) {
  if (waiting_.is_empty()) return;
  const SaveState state = executive_->saver().state();
  waiting_.take([&](const Waiting& one) { return state.answered >= one.number || now >= one.overdue_at; },
                [&](const Waiting& waiting) {
                  if (state.answered >= waiting.number) return answer(waiting.caller, state);
                  answers_->refuse(waiting.caller, no_answer_of_disk(patience));
                });
}

void SaveOperations::answer(const Caller& caller, const SaveState& state) {
  if (state.failure) {
    return answers_->done(caller, [&state](JsonWriter& json) { json.member("saved_at_ms", state.saved_at); });
  }
  answers_->refuse(caller, not_saved(RefusalKind::not_stored, state.failure));
}

}  // namespace flexrf::panel
