// Calls of the memory allocator by threads with certain names. The executable needs FlexRF::allocation_guard,
// which passes each call on to the C library under a name that is counted here.
#pragma once

#include <cstdint>
#include <span>

namespace flexrf::bench {

/// Before the threads begin; the names live for ever, at most 64. A thread has its name when it first
/// allocates.
void count_allocations_of(std::span<const char* const> names) noexcept;
/// Allocations and releases so far by the threads that have the n-th name.
std::uint64_t allocations_of(std::size_t name) noexcept;

}  // namespace flexrf::bench
