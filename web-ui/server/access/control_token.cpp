#include "web-ui/server/access/control_token.hpp"

#include <algorithm>

namespace flexrf::panel {

ControlToken::Taking ControlToken::take(const Asker& asker, Time now) noexcept {
  if (!asker.is_operator) return Taking::refused_role;
  if (holder_.session == asker.session) return Taking::taken;
  if (holder_.session == no_session) {
    give(asker);
    return Taking::taken;
  }
  if (holder_.is_local && !asker.is_local) return Taking::refused_local;
  // Who stands at the machine sees what moves.
  if (asker.is_local && !holder_.is_local) {
    give(asker);
    return Taking::taken;
  }
  if (asker_.session == asker.session) return Taking::asked;  // asking again neither hastens nor delays it
  if (asker_.session != no_session) return Taking::refused_asked;
  asker_ = asker;
  deadline_ = now + time_to_answer;
  ++revision_;
  return Taking::asked;
}

void ControlToken::release(SessionIndex session) noexcept {
  if (session == no_session) return;
  if (asker_.session == session) {
    asker_ = {};
    ++revision_;
  }
  // What its holder lets go goes to who waits for it.
  if (holder_.session == session) give(asker_);
}

bool ControlToken::answer(SessionIndex session, bool grant) noexcept {
  if (session == no_session || session != holder_.session || asker_.session == no_session) return false;
  if (grant) {
    give(asker_);
  } else {
    asker_ = {};
    ++revision_;
  }
  return true;
}

void ControlToken::update(Time now, bool holder_is_there) noexcept {
  if (asker_.session != no_session && !holder_is_there) {
    deadline_ = now + time_to_answer;
    return;
  }
  if (asker_.session != no_session && now >= deadline_) give(asker_);
}

Duration ControlToken::answer_within(Time now) const noexcept {
  return asker_.session == no_session ? Duration::zero() : std::max(deadline_ - now, Duration::zero());
}

void ControlToken::give(const Asker& to) noexcept {
  const SessionIndex from = holder_.session;
  holder_ = to;  // `to` may be asker_, which goes next
  asker_ = {};
  ++revision_;
  if (watcher_ != nullptr) watcher_->on_control_changed(from, holder_.session);
}

}  // namespace flexrf::panel
