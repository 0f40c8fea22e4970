// The boot choice on its medium: two copies that are written in turn, and the file in which GRUB counts.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>

#include "base/status.hpp"
#include "image/boot/blocks.hpp"
#include "image/boot/choice.hpp"
#include "image/boot/medium.hpp"

namespace flexrf::boot {

/// The names are short ones of FAT, so that a folder's entry is one.
inline constexpr std::array<const char*, 2> copy_names = {"choice0.env", "choice1.env"};
inline constexpr const char* attempts_name = "attempts.env";

/// Reads once, when it is made. What it writes it knows. The order of writes and flushes is what survives a
/// power cut: there is never a moment in which both copies are on their way to the disk.
class Environment {
 public:
  explicit Environment(Medium& medium);

  bool has_choice() const noexcept { return newest_.has_value(); }
  /// That of the newer copy, of the first if both are equally new, as GRUB takes it. Only with has_choice().
  const Choice& choice() const noexcept { return copies_[*newest_].choice; }
  /// Both copies can be read, and say the same.
  bool has_two_equal_copies() const noexcept;
  /// Why a copy is none; ok for one that is.
  const Status& damage_of(std::size_t copy) const noexcept { return copies_[copy].damage; }

  /// Which copies are none, and why, for a person: "choice0.env is damaged: its checksum does not match;
  /// ...".
  std::string damages() const;

  const Attempts& attempts() const noexcept { return attempts_; }
  const Status& damage_of_attempts() const noexcept { return attempts_damage_; }

  /// Makes it the choice: over the older copy, flushed, then over the other, flushed. The counter is set to
  /// one more than the choice's so far, or is the given one's if there is none so far. On failure the choice
  /// may be the old or the new one.
  Status write(Choice next);
  /// Writes the newer copy over the other one. Only with has_choice().
  Status write_other_copy();
  Status write(const Attempts& next);

 private:
  struct Copy {
    Choice choice;
    Status damage;
  };

  Status write_copy(std::size_t copy, const Choice& next);

  Medium& medium_;
  std::array<Copy, 2> copies_;
  std::optional<std::size_t> newest_;
  Attempts attempts_;
  Status attempts_damage_;
};

}  // namespace flexrf::boot
