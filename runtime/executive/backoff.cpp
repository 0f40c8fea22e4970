#include "runtime/executive/backoff.hpp"

#include <algorithm>
#include <cmath>

namespace flexrf {

namespace {

/// Intervals this many times apart are not one rhythm.
constexpr double apart = 8;
/// A spread above this part of the mean is no rhythm: such a source is polled in even steps.
constexpr double irregular = 2.5;
/// How often a source that gives several items at once is looked at in between.
constexpr std::uint32_t exploration = 2;

double between(Time from, Time to) noexcept {
  return static_cast<double>((to - from).count());
}
Duration rounded(double nanoseconds) noexcept {
  return Duration{static_cast<std::int64_t>(nanoseconds)};
}

}  // namespace

void Backoff::Rhythm::start(double interval) noexcept {
  mean = interval;
  spread = interval / 8;
}

void Backoff::Rhythm::add(double interval) noexcept {
  // One lost item or one pause is not to drown what was learned; a lasting change still wins, as the spread
  // grows.
  const double limit = std::max(4 * spread, mean / 16);
  const double error = std::clamp(interval - mean, -limit, limit);
  spread += (std::abs(error) - spread) / 8;
  mean += error / 8;
}

void Backoff::learn(double interval, double count) noexcept {
  if (interval <= 0) return;
  if (rhythm_.mean == 0) {
    rhythm_.start(interval);
    return;
  }
  if (burst_.mean == 0) {
    if (interval * apart < rhythm_.mean) {
      burst_.start(interval / count);
      burst_share_ = 0.25;
    } else if (interval > apart * rhythm_.mean) {
      burst_ = rhythm_;
      burst_share_ = 0.75;
      rhythm_.start(interval);
    } else {
      rhythm_.add(interval);
    }
    return;
  }
  const bool within = interval * interval < burst_.mean * rhythm_.mean;
  // Of several items in a burst only the last is told of: the others came evenly in between.
  if (within)
    burst_.add(interval / count);
  else
    rhythm_.add(interval);
  burst_share_ += ((within ? 1.0 : 0.0) - burst_share_) / 16;
  // One of the two was a passing disturbance, or both have become one.
  const bool one = rhythm_.mean < apart / 2 * burst_.mean;
  if (burst_share_ > 0.95 || (one && burst_share_ > 0.5)) rhythm_ = burst_;
  if (burst_share_ < 0.05 || burst_share_ > 0.95 || one) burst_ = {};
}

double Backoff::margin(const Rhythm& rhythm) const noexcept {
  return std::max(2 * rhythm.spread, static_cast<double>(limits_.shortest.count()) / 2);
}

Time Backoff::bounded(Time now, Time wanted) const noexcept {
  return std::clamp(wanted, now + limits_.shortest, now + limits_.longest);
}

Time Backoff::expect(Time now, bool in_burst) noexcept {
  misses_ = 0;
  in_burst_ = in_burst;
  const Rhythm& rhythm = in_burst ? burst_ : rhythm_;
  due_ = visible_ + rounded(rhythm.mean);
  if (!in_burst && rhythm.spread * irregular > rhythm.mean) {
    step_ = std::max(limits_.shortest, rounded(rhythm.mean / 2));
    due_ = now;
    return bounded(now, now + step_);
  }
  step_ = std::max(limits_.shortest, rounded(2 * margin(rhythm) / limits_.tries));
  // In a burst a single poll, when the item should be there; else from just before.
  return bounded(now, in_burst ? due_ + rounded(margin(rhythm)) : due_ - rounded(margin(rhythm)));
}

Time Backoff::hit(Time now, Time arrived, std::uint64_t count) noexcept {
  const bool is_first = arrived_ == Time{};
  const bool knows_arrival = arrived < now;
  const bool was_missed = last_miss_ > visible_;
  const double lead = margin(in_burst_ ? burst_ : rhythm_) / 8;
  // The item could be polled from between the last miss and now; a hit at first try says nothing of how long
  // it was there, so the next is looked for a little earlier.
  Time visible =
      knows_arrival ? std::min(arrived + rounded(delay_), now) : std::min(now, is_first ? now : due_);
  if (was_missed) {
    // Of several items `due` meant the first, and the last of them counts.
    const Duration others =
        (now - last_miss_) / static_cast<std::int64_t>(count) * static_cast<std::int64_t>(count - 1);
    visible = knows_arrival ? std::max(visible, last_miss_) : std::clamp(due_, last_miss_ + others, now);
  } else if (!is_first)
    visible -= rounded(lead);
  if (knows_arrival) delay_ = std::max(0.0, delay_ + (between(arrived, visible) - delay_) / 4);
  const Time now_arrived = knows_arrival ? arrived : visible;
  const double interval = is_first ? 0 : between(arrived_, now_arrived);
  arrived_ = now_arrived;
  visible_ = visible;
  // The time in which the items came while nobody looked.
  const double unseen = between(was_missed ? last_miss_ : hit_at_, now);
  hit_at_ = now;
  learn(interval, static_cast<double>(count));
  if (rhythm_.mean == 0) {
    misses_ = 0;
    step_ = limits_.shortest;
    return now + limits_.shortest;
  }
  if (count > 1 && ++batches_ % exploration == 0) {
    // They may have come together, or one after the other.
    misses_ = 0;
    in_burst_ = true;
    due_ = now + rounded(unseen / static_cast<double>(count));
    return bounded(now, due_);
  }
  return expect(now, burst_.mean > 0 && burst_share_ >= 0.2);
}

Time Backoff::miss(Time now) noexcept {
  last_miss_ = now;
  if (in_burst_) {
    if (++misses_ == 1 && burst_.mean > 0) return bounded(now, now + rounded(2 * margin(burst_)));
    return expect(now, false);
  }
  if (rhythm_.mean > 0) {
    // Woken early, because the longest sleep is shorter than the rhythm.
    const Time first = due_ - rounded(margin(rhythm_));
    if (now < first) return bounded(now, first);
  } else if (misses_ == 0) {
    step_ = limits_.shortest;
  }
  if (++misses_ > limits_.tries) step_ = std::min(2 * step_, limits_.longest);
  return bounded(now, now + step_);
}

}  // namespace flexrf
