#include "runtime/executive/heartbeat_watch.hpp"

#include "runtime/executive/supervision.hpp"
#include "runtime/log/log.hpp"

namespace flexrf {

void HeartbeatWatch::observe(Time now, bool stuck) noexcept {
  Heartbeat& heartbeat = cell_->heartbeat();
  if (!heartbeat.is_watched()) return;
  const Duration missed = missed_time_.until(now);
  for (Heard& heard : heard_) heard.at = has_looked_ ? heard.at + missed : now;
  has_looked_ = true;
  const char* silent = find_silent(now);
  if (stuck && silent == nullptr) silent = cell_->application().name;
  // Why it is given up was said by who did it.
  if (silent != nullptr && heartbeat.missed_by() == nullptr && !stuck)
    log_error(silent, "no sign of life; watchdogs are not fed");
  if (silent == nullptr && heartbeat.missed_by() != nullptr)
    log_warning(cell_->application().name, "every thread gives signs of life again; watchdogs are fed");
  heartbeat.judge(now, silent);
}

const char* HeartbeatWatch::find_silent(Time now) noexcept {
  const Application& application = cell_->application();
  const char* silent = nullptr;
  for (std::size_t i = 0; i < application.threads.size(); ++i) {
    const std::uint64_t turns = application.thread_states[i].turns.load(std::memory_order_acquire);
    if (turns != heard_[i].turns) {
      heard_[i] = {turns, now};
      continue;
    }
    const Duration limit = Supervision::hang_timeout(application.threads[i]);
    const Duration silence = now - heard_[i].at;
    if (silence > limit / 4) application.threads[i].bell->ring();
    if (silence > limit && silent == nullptr) silent = application.threads[i].name;
  }
  return silent;
}

}  // namespace flexrf
