// CameraJournal: what every driver of Camera counts and tells.
#pragma once

#include <cstdint>
#include <string_view>

#include "hal/camera/interface/camera.hpp"

namespace flexrf {

/// The thread the camera lives in.
class CameraJournal {
 public:
  /// Forgets all. `name`: of the device, for the log; outlives this.
  void restart(const char* name) noexcept;

  /// The camera begins to count its pictures anew.
  void begin_stream() noexcept { first_ = true; }
  /// A picture came whole, `sequence` in the camera's own count, which may wrap around. Returns its sequence
  /// as readers see it, which never does [camera-journal-1].
  std::uint64_t note_whole(std::uint32_t sequence) noexcept;
  /// One came that is not given on; `why` is logged when it is another reason than the last.
  void note_damaged(std::uint32_t sequence, std::string_view why) noexcept;

  /// No pictures come from now on, or since the start; `why` is what the operator reads, there and in the
  /// log. Told again while they are away, it only changes the reason [camera-journal-2].
  void note_away(std::string_view why) noexcept;
  /// Of one that is there: what else is wrong with it; empty: nothing.
  void note_trouble(std::string_view what) noexcept { set_text(trouble_, what); }

  bool is_present() const noexcept { return present_; }
  void fill(CameraFeedback& feedback) const noexcept;

 private:
  std::uint64_t advance(std::uint32_t sequence) noexcept;

  const char* name_ = "";
  bool present_ = false;
  bool was_present_ = false;  // ever
  bool first_ = true;
  std::uint32_t last_ = 0;
  std::uint64_t sequence_ = 0;
  std::uint64_t frames_ = 0;
  std::uint64_t lost_ = 0;
  std::uint64_t damaged_ = 0;
  std::uint64_t losses_ = 0;
  std::uint64_t recoveries_ = 0;
  std::array<char, 80> damage_{};
  std::array<char, 240> trouble_{};
  std::array<char, 240> away_{};
};

}  // namespace flexrf
