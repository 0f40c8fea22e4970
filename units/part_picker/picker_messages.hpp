// What a person reads of the picker: what it is at or what is wrong, and what to do.
#pragma once

#include <array>

#include "units/part_picker/picker_machine.hpp"

namespace flexrf::user {

struct PickerMessage {
  std::array<char, 240> message{};  ///< zero-terminated
  const char* remedy = "";          ///< lives for ever
};

/// As of the machine's last step with this view. `sight`: why the camera tells nothing.
PickerMessage describe(const PickerMachine& machine, const PickerView& view, const char* sight) noexcept;

}  // namespace flexrf::user
