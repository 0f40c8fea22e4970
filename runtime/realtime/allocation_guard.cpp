// The allocation functions of the C library, behind a look at whether the thread may allocate now. Linked
// into an executable (FlexRF::allocation_guard), they take the library's place for all its parts; operator
// new comes through malloc.

#include <errno.h>

#include <cstddef>
#include <cstdlib>
#include <cstring>

#include "runtime/realtime/last_gasp.hpp"
#include "runtime/realtime/realtime_scope.hpp"

extern "C" {
// glibc's own names for what is forwarded to.
void* __libc_malloc(std::size_t size) noexcept;
void __libc_free(void* memory) noexcept;
void* __libc_calloc(std::size_t count, std::size_t size) noexcept;
void* __libc_realloc(void* memory, std::size_t size) noexcept;
void* __libc_memalign(std::size_t alignment, std::size_t size) noexcept;

extern const char flexrf_allocation_guard;
const char flexrf_allocation_guard = 1;
}

namespace flexrf {

namespace {

[[gnu::noinline, gnu::cold]] void forbidden([[maybe_unused]] const char* function) noexcept {
  AllocationCounter& counter = *detail::allocation_counter;
  counter.store(counter.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
#if FLEXRF_CHECKED
  char message[128] = "\nflexrf: ";
  std::strcat(message, function);
  std::strcat(message, " called in a real-time thread, where nothing may be allocated or freed:\n");
  last_gasp::abort_with_trace(message);
#endif
}

inline void check(const char* function) noexcept {
  if (detail::allocation_counter != nullptr) [[unlikely]]
    forbidden(function);
}

bool is_power_of_two(std::size_t value) noexcept {
  return value != 0 && (value & (value - 1)) == 0;
}

}  // namespace

}  // namespace flexrf

extern "C" {

void* malloc(std::size_t size) noexcept {
  flexrf::check("malloc");
  return __libc_malloc(size);
}

void free(void* memory) noexcept {
  if (memory == nullptr) return;
  flexrf::check("free");
  __libc_free(memory);
}

void* calloc(std::size_t count, std::size_t size) noexcept {
  flexrf::check("calloc");
  return __libc_calloc(count, size);
}

void* realloc(void* memory, std::size_t size) noexcept {
  flexrf::check("realloc");
  return __libc_realloc(memory, size);
}

void* memalign(std::size_t alignment, std::size_t size) noexcept {
  flexrf::check("memalign");
  return __libc_memalign(alignment, size);
}

void* aligned_alloc(std::size_t alignment, std::size_t size) noexcept {
  flexrf::check("aligned_alloc");
  return __libc_memalign(alignment, size);
}

int posix_memalign(void** memory, std::size_t alignment, std::size_t size) noexcept {
  flexrf::check("posix_memalign");
  if (alignment % sizeof(void*) != 0 || !flexrf::is_power_of_two(alignment)) return EINVAL;
  void* const allocated = __libc_memalign(alignment, size);
  if (allocated == nullptr) return ENOMEM;
  *memory = allocated;
  return 0;
}
}
