#include "hal/camera/interface/camera_journal.hpp"

#include "runtime/log/log.hpp"

namespace flexrf {

void CameraJournal::restart(const char* name) noexcept {
  *this = {};
  name_ = name;
}

std::uint64_t CameraJournal::note_whole(std::uint32_t sequence) noexcept {
  const std::uint64_t readers = advance(sequence);
  ++frames_;
  if (!present_) {
    present_ = true;
    if (was_present_) {
      ++recoveries_;
      log_info(name_, "pictures come again");
    }
    was_present_ = true;
    away_ = {};
  }
  return readers;
}

void CameraJournal::note_damaged(std::uint32_t sequence, std::string_view why) noexcept {
  advance(sequence);
  ++damaged_;
  if (text_view(damage_) == why.substr(0, damage_.size())) return;
  set_text(damage_, why);
  log_warning(name_, "a picture is left out: {}", text_view(damage_));
}

void CameraJournal::note_away(std::string_view why) noexcept {
  if (present_) ++losses_;
  present_ = false;
  if (text_view(away_) == why.substr(0, away_.size())) return;
  set_text(away_, why);
  log_warning(name_, "{}", text_view(away_));
}

void CameraJournal::fill(CameraFeedback& feedback) const noexcept {
  feedback.present = present_;
  feedback.trouble = away_[0] != '\0' ? away_ : trouble_;
  feedback.frames = frames_;
  feedback.lost_frames = lost_;
  feedback.damaged_frames = damaged_;
  feedback.damage = damage_;
  feedback.losses = losses_;
  feedback.recoveries = recoveries_;
}

/// A count that steps back, or stays, was begun anew by the camera: nothing is known to be lost.
std::uint64_t CameraJournal::advance(std::uint32_t sequence) noexcept {
  const std::uint32_t step = sequence - last_;
  const bool forward = !first_ && step != 0 && step < 0x8000'0000U;
  first_ = false;
  last_ = sequence;
  sequence_ += forward ? step : 1;
  if (forward) lost_ += step - 1;
  return sequence_;
}

}  // namespace flexrf
