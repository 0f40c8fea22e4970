// The one control token: whoever holds it may change things.
#pragma once

#include <cstdint>

#include "base/time.hpp"
#include "web-ui/server/access.hpp"

namespace flexrf::panel {

/// Allocates nothing. The server's thread.
class ControlToken {
 public:
  static constexpr Duration time_to_answer = std::chrono::seconds{10};
  using Taking = AccessControl::Taking;

  struct Asker {
    SessionIndex session = no_session;
    bool is_operator = false;  ///< or more
    bool is_local = false;
  };

  /// A free token is taken at once, and by who is local that of one who is not; else its holder is asked, and
  /// no answer is consent. One waits at a time.
  Taking take(const Asker& asker, Time now) noexcept;
  /// Given back by its holder, or the question withdrawn by who asked; nothing for anybody else.
  void release(SessionIndex session) noexcept;
  /// The holder's answer; false: it is not the holder, or nobody asks.
  bool answer(SessionIndex session, bool grant) noexcept;
  /// Gives it to who waited long enough. Silence is an answer only of a holder who can see the question:
  /// while he is not `there` the time does not run, and begins anew when he is back.
  void update(Time now, bool holder_is_there) noexcept;

  SessionIndex holder() const noexcept { return holder_.session; }
  SessionIndex wanted_by() const noexcept { return asker_.session; }
  Duration answer_within(Time now) const noexcept;  ///< zero when nobody asks
  std::uint64_t revision() const noexcept { return revision_; }
  /// Told of every change of the holder, after it.
  void watch(AccessWatcher& watcher) noexcept { watcher_ = &watcher; }

 private:
  void give(const Asker& to) noexcept;

  Asker holder_;
  Asker asker_;
  Time deadline_{};
  std::uint64_t revision_ = 0;
  AccessWatcher* watcher_ = nullptr;
};

}  // namespace flexrf::panel
