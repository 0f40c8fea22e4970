// Limits that the runtime sets. config-gen knows nothing of the runtime, so a test compares them with its
// own.
#pragma once

#include <cstddef>

namespace flexrf::config_gen {

constexpr std::size_t max_runtime_size = 4096;   // bytes of one component's runtime parameters
constexpr std::size_t max_holds = 16;            // of one component
constexpr std::size_t max_trigger_sources = 32;  // slots and queues that release one thread

}  // namespace flexrf::config_gen
