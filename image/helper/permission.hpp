// Whether anything may move on this PC: the helper's word for the application (--motion-permit).
#pragma once

#include <optional>
#include <string>

#include "base/status.hpp"
#include "image/boot/choice.hpp"
#include "image/helper/update_progress.hpp"

namespace flexrf::helper {

/// What is known of this PC at one moment.
struct Facts {
  bool is_claimed = false;  ///< somebody has the password of an admin
  boot::Running running;    ///< what GRUB told
  /// What the disk says; none: it cannot be read, and `choice_failure` says why.
  std::optional<boot::Choice> choice;
  std::string choice_failure;
  unsigned attempts = 0;  ///< to start what the choice means, that count: nobody has given them back
  Phase update = Phase::none;
  std::string update_failure;
  std::string address_on_trial;  ///< of this interface; empty: of none
};

/// What the application reads when it may move.
inline constexpr const char* permitted = "permitted";
/// What it reads while an update is installed.
inline constexpr const char* installing = "an update is being installed";

/// Whether the version that runs has confirmed itself. False when that cannot be told.
bool is_confirmed(const Facts& facts) noexcept;
/// GRUB fell back to this version from the trial that the choice still means: it becomes the primary when it
/// is found healthy, whether it is confirmed already or not.
bool is_fallen_back_to(const Facts& facts) noexcept;
/// The version that runs is confirmed, and its starts count until it has come up.
bool has_to_come_up(const Facts& facts) noexcept;
/// A version on trial that does not come to be healthy, or a confirmed one that does not come up, gives up
/// its turn by a restart: there is another one that is whole.
bool has_another_turn(const Facts& facts) noexcept;

/// `permitted`, or why nothing may move, in one line: what the operator reads at Start.
std::string permission_of(const Facts& facts);

}  // namespace flexrf::helper
