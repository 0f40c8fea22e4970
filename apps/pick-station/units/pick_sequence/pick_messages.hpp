// What a person reads of the cell: what it is at or what is wrong, and what to do.
#pragma once

#include <array>

#include "apps/pick-station/units/pick_sequence/pick_machine.hpp"

namespace flexrf::user {

struct PickMessage {
  std::array<char, 240> message{};  ///< zero-terminated
  const char* remedy = "";
};

/// As of the machine's last step with this view.
PickMessage describe(const PickMachine& machine, const PickView& view, const PickWishes& wishes) noexcept;

}  // namespace flexrf::user
