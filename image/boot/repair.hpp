// What is damaged of the boot choice made whole again, early in each boot.
#pragma once

#include "image/boot/choice.hpp"
#include "image/boot/environment.hpp"
#include "image/boot/verbs.hpp"

namespace flexrf::boot {

/// Says what it found, each in a line, even where there was nothing to be done about it. A power cut at any
/// time leaves at least what could be read before.
Outcome repair(Environment& environment, const Running& running);

}  // namespace flexrf::boot
