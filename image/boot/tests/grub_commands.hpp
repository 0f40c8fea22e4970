// GRUB's commands, as far as grub.cfg calls them.
#pragma once

#include <string>
#include <vector>

#include "image/boot/tests/grub_machine.hpp"

namespace flexrf::boot {

/// `load_env`, `regexp` and so on. True: success. Throws ScriptError for a command or an option that is not
/// known here.
bool run_grub_command(GrubMachine& machine, Started& started, const std::vector<std::string>& words);

/// Thrown where GRUB gives control away.
struct GrubHasLeft {};

}  // namespace flexrf::boot
