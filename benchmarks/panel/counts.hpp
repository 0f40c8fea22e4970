// What counting.cpp counts, in a file that the benchmark reads.
#pragma once

#include <atomic>
#include <cstdint>

namespace flexrf::bench {

struct Counts {
  std::atomic<std::uint64_t> allocations;           ///< and releases, by the server's thread
  std::atomic<std::uint64_t> encoders_allocations;  ///< by the thread that makes JPEG
  std::atomic<std::uint64_t> encodings;             ///< pictures that became JPEG
};

}  // namespace flexrf::bench
