// What a checked build does to loans, so that nobody relies on what was in them.
#include "runtime/blackboard/slot.hpp"

namespace flexrf {

#if FLEXRF_CHECKED
const bool SlotControl::poisons_loans = true;
#else
const bool SlotControl::poisons_loans = false;
#endif

void SlotControl::poison(std::uint8_t buffer) noexcept {
  std::memset(payload(buffer), 0xA5, type_->size);
  lay_out(buffer);
}

}  // namespace flexrf
