// Memory that need not be there at every instant. Real time locks all of a process's memory; what none but
// the panel's own threads use is given back to the kernel's ordinary care.
#pragma once

#include <cstddef>
#include <memory>

namespace flexrf::panel {

struct OrdinaryMemoryRelease {
  std::size_t size = 0;
  void operator()(char* memory) const noexcept;
};
using OrdinaryMemory = std::unique_ptr<char[], OrdinaryMemoryRelease>;

/// Zeroed. Any thread; throws std::bad_alloc as new does.
OrdinaryMemory make_ordinary_memory(std::size_t size);

/// Takes the lock off memory that was made before all was locked; it is zeroed.
void unlock(const OrdinaryMemory& memory) noexcept;

/// Takes the lock off the code and constants of libraries that only the panel uses (encryption, pictures,
/// JSON); what is used of them comes back by itself. After all memory was locked; any one thread.
void unlock_libraries() noexcept;

}  // namespace flexrf::panel
