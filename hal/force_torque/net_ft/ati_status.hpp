// What the bits of an ATI sensor's status mean.
#pragma once

#include <cstdint>

#include "base/status.hpp"
#include "types/ati_family.hpp"

namespace flexrf {

/// The sensor says that the load is beyond what it measures.
bool is_saturated(std::uint32_t status, AtiFamily family) noexcept;
/// Ok, also with an overload or with bits that only tell; else what is wrong with the sensor, with the bits.
Status check_status(std::uint32_t status, AtiFamily family) noexcept;

}  // namespace flexrf
