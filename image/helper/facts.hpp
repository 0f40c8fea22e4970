// What is known of this PC, read anew.
#pragma once

#include <string>

#include "base/time.hpp"
#include "image/helper/files.hpp"
#include "image/helper/named_lines.hpp"
#include "image/helper/permission.hpp"

namespace flexrf::helper {

/// Another process has the boot choice only for as long as a change takes; so long it is waited for.
inline constexpr Duration wait_for_choice = std::chrono::seconds{2};

/// `wait`: for the boot choice. Any thread.
Facts read_facts(const Files& files, Duration wait);
/// What stands in it tells the version in a slot to the one in the other. Any thread.
std::string version_file(const UpdateFiles& files, boot::Slot slot);
/// Reads version_file(). Empty where it cannot be read. Any thread.
NamedLines version_lines(const UpdateFiles& files, boot::Slot slot);
/// What GRUB told of this boot. Any thread.
boot::Running read_running(const Files& files);

}  // namespace flexrf::helper
