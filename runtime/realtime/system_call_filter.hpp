// Watches the system calls of real-time threads, as the allocation guard watches their allocations.
#pragma once

#include "base/status.hpp"

namespace flexrf {

// Both are part of the guard's object (FlexRF::allocation_guard) in the checked build, and null elsewhere.

/// Prepares the filter and what its report needs. At start, main thread. unavailable: this kernel has no
/// seccomp filters, and the calls are not watched.
[[gnu::weak]] Status prepare_system_call_filter() noexcept;

/// From here to its end the calling thread may only wait for its release and do IO that does not block: any
/// other system call aborts the process, and says which call in which step it was. `thread`: its name, which
/// lives for ever. Nothing when the preparation failed. Allocates nothing.
[[gnu::weak]] Status filter_system_calls(const char* thread) noexcept;

}  // namespace flexrf
