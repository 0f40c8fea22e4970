#pragma once

#include "base/status.hpp"

namespace flexrf::raw_terminal {

/// Keys come one by one and are not echoed; Ctrl-C, Ctrl-\ and Ctrl-Z keep their meaning, and output is as
/// before. One terminal per process. Who stops the process gives it back before
/// (last_gasp::restore_terminal()), fg makes it raw again; a crash or exit() gives it back too. A process in
/// the background makes it raw when it comes to the foreground. Lifecycle thread.
Status enter(int terminal) noexcept;

/// As it was before enter(); nothing when it is not raw.
void leave() noexcept;

}  // namespace flexrf::raw_terminal
