// Which version of the disk boots: two slots, what is known of each, and which one is meant. Pure values;
// files are below.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "base/status.hpp"

namespace flexrf::boot {

/// A place for one version on the disk: a partition that boots and one with the root. RAUC's boot names are
/// "A" and "B".
enum class Slot : std::uint8_t { a, b };

constexpr Slot other(Slot slot) noexcept {
  return slot == Slot::a ? Slot::b : Slot::a;
}
constexpr std::size_t index_of(Slot slot) noexcept {
  return static_cast<std::size_t>(slot);
}
constexpr char letter_of(Slot slot) noexcept {
  return slot == Slot::a ? 'A' : 'B';
}
/// Nothing for any other text than "A" and "B".
std::optional<Slot> slot_named(std::string_view name) noexcept;

/// What is known of a slot. One that is confirmed is whole.
struct Marks {
  bool is_whole = false;      ///< all of the version has been written, and nothing writes over it
  bool is_confirmed = false;  ///< the version has run here and found itself healthy

  friend bool operator==(const Marks&, const Marks&) = default;
};

/// The last number that fits into the ten digits of a counter. With a change a second it lasts 300 years.
inline constexpr std::uint64_t last_counter = 9'999'999'999;

/// What both files hold, and GRUB decides by.
struct Choice {
  std::uint64_t counter = 1;     ///< one more with each change: the copy with the greater one is the newer
  Slot primary = Slot::a;        ///< the slot that is meant to boot
  std::uint64_t trial = 1;       ///< the counter with which it became that; GRUB counts the attempts since
  std::array<Marks, 2> marks{};  ///< by index_of(slot)

  Marks& of(Slot slot) noexcept { return marks[index_of(slot)]; }
  const Marks& of(Slot slot) const noexcept { return marks[index_of(slot)]; }
  friend bool operator==(const Choice&, const Choice&) = default;
};

/// What GRUB told the kernel's command line about this boot. RAUC reads the same `rauc.slot=`.
struct Running {
  /// `rauc.slot=`
  std::optional<Slot> slot;
  /// `flexrf.boot=`: confirmed, trial, only, fallback, unknown or manual; empty if it is none of these.
  std::string why;
  /// `flexrf.trial=`: the choice's, as GRUB read it; 0 if it is not there or no number.
  std::uint64_t trial = 0;
};

/// Of a word that is there twice the last counts.
Running running_from(std::string_view kernel_command_line);

/// The version of slot A alone is on the disk, and has yet to confirm itself.
Choice choice_of_new_disk() noexcept;
/// All that is known when there is no choice left: the slot that runs is whole.
Choice choice_of_running(Slot slot) noexcept;

// The changes. Each gives what the choice becomes; the counter is set when it is written. not_permitted, with
// the reason, where the state does not allow it.

/// Begins a trial, which matters unless the slot is confirmed. It may still lack its mark: RAUC chooses
/// before its last handler runs, and GRUB goes by the mark.
Choice with_primary(Choice choice, Slot slot) noexcept;
Choice with_whole_mark(Choice choice, Slot slot) noexcept;
/// The slot is about to be written over, or somebody says that it is bad. Not permitted where no whole slot
/// would be left.
Result<Choice> without_whole_mark(Choice choice, Slot slot);
/// The running slot found itself healthy. If GRUB fell back to it from the trial that the choice still means,
/// it is what boots from now on. Not permitted for a slot that does not run, or is not whole.
Result<Choice> with_confirmation(Choice choice, Slot slot, const Running& running);

}  // namespace flexrf::boot
