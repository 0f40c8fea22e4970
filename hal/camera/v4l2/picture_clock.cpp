#include "hal/camera/v4l2/picture_clock.hpp"

#include <algorithm>

namespace flexrf {

const char* words_for(StampSource source) noexcept {
  switch (source) {
    case StampSource::end_of_frame:
      return "end of frame";
    case StampSource::begin_of_exposure:
      return "begin of exposure";
    case StampSource::arrival:
      break;
  }
  return "arrival";
}

void PictureClock::begin(const ExposurePlan& plan, Time now) noexcept {
  const Duration unknown = plan.period / 2;
  const Duration exposure = plan.exposure > Duration{} ? plan.exposure : unknown;
  const Duration readout = plan.readout > Duration{} ? plan.readout : unknown;
  period_ = plan.period;
  from_begin_ = (exposure + (plan.rolling ? readout : Duration{})) / 2;
  to_end_ = exposure / 2 + (plan.rolling ? readout / 2 : readout);
  source_ = StampSource::arrival;
  looked_at_ = now;
  stamp_ = {};
}

Time PictureClock::exposed_at(const PictureStamp& stamp, Time now) noexcept {
  source_ = is_believed(stamp, now) ? stamp.source : StampSource::arrival;
  if (source_ != StampSource::arrival) stamp_ = stamp.time;
  const Time exposed = source_ == StampSource::begin_of_exposure ? std::min(stamp.time + from_begin_, now)
                       : source_ == StampSource::end_of_frame    ? stamp.time - to_end_
                                                                 : now - to_end_;
  given_ = std::max(exposed, given_ + Duration{1});
  return given_;
}

bool PictureClock::is_believed(const PictureStamp& stamp, Time now) const noexcept {
  if (stamp.source == StampSource::arrival) return false;
  const Duration on_its_way = stamp.source == StampSource::begin_of_exposure ? 2 * period_ : period_;
  return stamp.time <= now && stamp.time > stamp_ && stamp.time >= looked_at_ - on_its_way;
}

}  // namespace flexrf
