// PictureClock: when a picture was exposed, from what the kernel says of it.
#pragma once

#include <cstdint>

#include "base/time.hpp"

namespace flexrf {

/// What the kernel's stamp of a picture means.
enum class StampSource : std::uint8_t {
  arrival,            ///< nothing that can be used: it is not by CLOCK_MONOTONIC
  end_of_frame,       ///< the last pixel was read out
  begin_of_exposure,  ///< the first row began to see
};
const char* words_for(StampSource source) noexcept;

struct PictureStamp {
  StampSource source = StampSource::arrival;
  Time time{};  ///< CLOCK_MONOTONIC
};

struct ExposurePlan {
  Duration period{};    ///< from picture to picture, as the camera agreed to; above 0
  Duration exposure{};  ///< of a row; 0: not known, taken as half of the period
  Duration readout{};   ///< of all rows; likewise
  bool rolling = true;  ///< each row is read out as soon as it is exposed; else all see at the same time
};

/// The time of a picture is the middle of its exposure, of a rolling shutter that of its middle row. A stamp
/// is believed unless it is ahead of now, not after that of the picture before, or older than a picture can
/// be that had not come when the last look found none: a period, and two where it is stamped at its begin. A
/// picture that has no such stamp is taken for one whose last pixel was read out when it came. One thread;
/// never blocks, never allocates.
class PictureClock {
 public:
  /// A stream begins.
  void begin(const ExposurePlan& plan, Time now) noexcept;
  /// A look found no more pictures.
  void note_none(Time now) noexcept { looked_at_ = now; }
  /// The next picture, taken at `now`: when it was exposed. Later than the one before, and at most `now`
  /// where that is.
  Time exposed_at(const PictureStamp& stamp, Time now) noexcept;
  /// What the time of the last picture comes from.
  StampSource source() const noexcept { return source_; }

 private:
  bool is_believed(const PictureStamp& stamp, Time now) const noexcept;

  Duration period_{};
  Duration from_begin_{};  // of the exposure to its middle
  Duration to_end_{};      // from there to the last pixel
  StampSource source_ = StampSource::arrival;
  Time looked_at_{};
  Time stamp_{};  // the last that was believed
  Time given_{};
};

}  // namespace flexrf
