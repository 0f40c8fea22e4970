#include "runtime/realtime/realtime_scope.hpp"

#include <execinfo.h>

// Defined by the guard's object where it is linked in.
extern "C" [[gnu::weak]] const char flexrf_allocation_guard;

namespace flexrf {

namespace detail {
constinit thread_local AllocationCounter* allocation_counter [[gnu::tls_model("initial-exec")]] = nullptr;
}  // namespace detail

RealtimeScope::RealtimeScope(AllocationCounter& counter) noexcept : outer_(detail::allocation_counter) {
  detail::allocation_counter = &counter;
}

RealtimeScope::~RealtimeScope() {
  detail::allocation_counter = outer_;
}

AllocationAllowed::AllocationAllowed() noexcept : outer_(detail::allocation_counter) {
  detail::allocation_counter = nullptr;
}

AllocationAllowed::~AllocationAllowed() {
  detail::allocation_counter = outer_;
}

bool has_allocation_guard() noexcept {
  return &flexrf_allocation_guard != nullptr;
}

void prepare_allocation_guard() noexcept {
  // The first backtrace loads the unwinder, which allocates.
  void* frames[4];
  backtrace(frames, 4);
}

}  // namespace flexrf
