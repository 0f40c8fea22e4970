#include "runtime/executive/overrun_log.hpp"

#include <algorithm>

#include "runtime/log/log.hpp"

namespace flexrf {
namespace {

constexpr Duration interval = std::chrono::seconds{10};

double milliseconds(Duration duration) noexcept {
  return seconds(duration) * 1e3;
}

}  // namespace

void OverrunLog::note(Time now, Duration late, std::uint64_t skipped, Duration skipped_time) noexcept {
  ++overruns_;
  skipped_ += skipped;
  skipped_time_ += skipped_time;
  latest_ = std::max(latest_, late);
  if (say_at_ == Time{}) say(now);
}

void OverrunLog::say(Time now) noexcept {
  if (overruns_ == 0 || now < say_at_) return;
  if (say_at_ == Time{}) {
    log_warning(thread_,
                "overrun: {:.1} ms late, {} releases ({:.1} ms) left out; more of them are summed up",
                milliseconds(latest_), skipped_, milliseconds(skipped_time_));
  } else {
    log_warning(thread_, "overruns since then: {}, {:.1} ms late at most, {} releases ({:.1} ms) left out",
                overruns_, milliseconds(latest_), skipped_, milliseconds(skipped_time_));
  }
  overruns_ = skipped_ = 0;
  skipped_time_ = latest_ = Duration{};
  if (now != Time::max()) say_at_ = now + interval;
}

}  // namespace flexrf
