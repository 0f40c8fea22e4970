#include "runtime/executive/step_trace.hpp"

#include <algorithm>

namespace flexrf {

StepTrace::Copied StepTrace::copy(Time since, std::span<TracedStep> steps) const noexcept {
  const std::uint64_t end = written_.load(std::memory_order_acquire);
  const std::uint64_t room = std::min<std::uint64_t>({end, most, steps.size()});
  // From the newest back, so that what is left out is the oldest.
  std::size_t count = 0;
  bool cut = false;
  while (count < room) {
    const std::uint64_t position = end - 1 - count;
    const Entry& entry = ring_[position % entries];
    const Time begin{Duration{entry.begin.load(std::memory_order_acquire)}};
    const std::uint64_t rest = entry.rest.load(std::memory_order_acquire);
    // Overwritten, or just being overwritten: so are all before it.
    if (position + entries <= written_.load(std::memory_order_relaxed)) {
      cut = true;
      break;
    }
    const Duration took{static_cast<std::int64_t>(rest >> unit_bits)};
    if (begin + took <= since) break;
    steps[count++] = {static_cast<std::uint16_t>(rest), begin, took};
  }
  // Of what lies before it is not known whether it ended before `since`.
  if (count == room && room < end) cut = true;
  std::reverse(steps.begin(), steps.begin() + static_cast<std::ptrdiff_t>(count));
  return {count, cut};
}

}  // namespace flexrf
