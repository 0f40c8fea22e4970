// How the generated application connects what units and devices read and publish.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

#include "runtime/blackboard/ports.hpp"

namespace flexrf {

/// Each kind of port in the order of its table; of a device its interface's, then its driver's.
struct PortBinding {
  const StepContext* context = nullptr;                        ///< of the thread it lives in
  std::span<const InputBinding> inputs;                        ///< of slots
  std::span<QueueSource* const> queue_inputs;                  ///< null: not connected
  std::span<SlotControl* const> outputs;                       ///< null: not connected
  std::span<const std::span<QueueSink* const>> queue_outputs;  ///< empty span: not connected

  // By its number. One that is not there is not connected: what stands in another object or in a test has
  // only what it is given.

  InputBinding input(std::size_t number) const noexcept {
    return number < inputs.size() ? inputs[number] : InputBinding{};
  }
  QueueSource* queue_input(std::size_t number) const noexcept {
    return number < queue_inputs.size() ? queue_inputs[number] : nullptr;
  }
  SlotControl* output(std::size_t number) const noexcept {
    return number < outputs.size() ? outputs[number] : nullptr;
  }
  /// Whether it has this queue's items.
  bool takes_from(const QueueSource* source) const noexcept {
    return std::find(queue_inputs.begin(), queue_inputs.end(), source) != queue_inputs.end();
  }
  std::span<QueueSink* const> queue_output(std::size_t number) const noexcept {
    return number < queue_outputs.size() ? queue_outputs[number] : std::span<QueueSink* const>{};
  }
};

}  // namespace flexrf
