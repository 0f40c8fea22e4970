// What every item on the blackboard carries beside its value, and what a reader learns when there is none.
#pragma once

#include <cstdint>

#include "runtime/core/time.hpp"

namespace flexrf {

/// Why a read gave the NULL item.
enum class NullReason : std::uint8_t {
  none,            ///< there is an item
  nothing_yet,     ///< nobody published since the application started
  too_old,         ///< older than the input's max_age
  writer_stopped,  ///< the unit that writes it was stopped
  writer_faulted,  ///< the unit that writes it is in fault
  writer_retired,  ///< the member of a population that writes it was retired
  not_registered,  ///< no slot of this name, or the input is not connected
  wrong_type,      ///< the slot's type is another
  no_longer_kept,  ///< a history no longer keeps that time
};
const char* name_of(NullReason reason) noexcept;

/// What a read says of the value against the reader's last step.
enum class Freshness : std::uint8_t { null, old_item, new_item };

/// State of a slot's writer, as its readers see it. Zero is the first state.
enum class WriterState : std::uint8_t { waiting, running, stopped, faulted, retired };

/// Beside each value in its buffer.
struct ItemHeader {
  std::uint64_t sequence;  ///< 1 for the first publication; 0: never published
  Time sampled_at;         ///< when the value was true: the step's time unless the writer said otherwise
};

/// What the executive tells the ports of the unit it steps. One per thread; written by that thread only.
struct StepContext {
  std::uint64_t step = 0;  ///< changes with every step of every unit of the thread; 0 before the first
  Time now{};  ///< the step's time: stamps what it publishes, and is what ages are measured against
};

}  // namespace flexrf
