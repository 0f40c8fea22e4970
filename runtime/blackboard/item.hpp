// What every item on the blackboard carries beside its value, and what a reader learns when there is none.
#pragma once

#include <cstddef>
#include <cstdint>

#include "base/time.hpp"
#include "runtime/core/type_descriptor.hpp"

namespace flexrf {

/// Why a read gave the NULL item.
enum class NullReason : std::uint8_t {
  none,               ///< there is an item
  nothing_yet,        ///< nobody published since the application started
  too_old,            ///< older than the input's max_age
  writer_stopped,     ///< the unit or device that writes it was stopped
  writer_faulted,     ///< the unit or device that writes it is in fault
  writer_retired,     ///< the member of a population that writes it was retired
  not_registered,     ///< no slot of this name, or the input is not connected
  wrong_type,         ///< the slot's type is another than the input's
  no_longer_kept,     ///< a history no longer keeps that time
  driver_not_chosen,  ///< only a driver writes it that was not chosen at the start
  ahead_of_time,      ///< stamped later than the step's time, by more than the input's max_age
  not_available,      ///< the device was asked, and says that it has no value
};
inline constexpr std::size_t null_reason_count = static_cast<std::size_t>(NullReason::not_available) + 1;
const char* name_of(NullReason reason) noexcept;

/// What a read says of the value against the reader's last step.
enum class Freshness : std::uint8_t { null, old_item, new_item };

/// State of a slot's writer, as its readers see it. Zero is the first state.
enum class WriterState : std::uint8_t { waiting, running, stopped, faulted, retired, not_chosen };

/// Beside each value in its buffer.
struct ItemHeader {
  std::uint64_t sequence;  ///< 1 for the first publication; 0: never published
  Time sampled_at;         ///< when the value was true: the step's time unless the writer said otherwise
};

/// Sequences wrap around modulo 2^64 and leave out 0, which means "never".
constexpr std::uint64_t next_sequence(std::uint64_t sequence) noexcept {
  return sequence + 1 == 0 ? 1 : sequence + 1;
}
/// How many sequences lie between two, both left out; from before to.
constexpr std::uint64_t sequences_between(std::uint64_t from, std::uint64_t to) noexcept {
  return to - from - 1 - (to < from ? 1 : 0);
}

/// What the writer's state alone makes of every read: none while it may publish.
constexpr NullReason null_reason_of(WriterState state) noexcept {
  switch (state) {
    case WriterState::stopped:
      return NullReason::writer_stopped;
    case WriterState::faulted:
      return NullReason::writer_faulted;
    case WriterState::retired:
      return NullReason::writer_retired;
    case WriterState::not_chosen:
      return NullReason::driver_not_chosen;
    case WriterState::waiting:
    case WriterState::running:
      break;
  }
  return NullReason::none;
}

/// The digest so far, with one item added: sequence, time, fields (no padding).
std::uint64_t digest_of_item(std::uint64_t so_far, const TypeDescriptor& type, const ItemHeader& header,
                             const void* value) noexcept;

/// What the executive tells the ports of what it steps. One per thread; written by that thread only.
struct StepContext {
  /// Changes with every step of every unit of the thread, and with every call of its devices; 0 before the
  /// first.
  std::uint64_t step = 0;
  Time now{};  ///< the step's time: stamps what it publishes, and is what ages are measured against
};

}  // namespace flexrf
