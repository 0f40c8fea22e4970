// What a station that exists in memory only does with its registers.
#pragma once

#include <cstdint>
#include <span>

#include "base/time.hpp"

namespace flexrf {

class ModbusStationModel {
 public:
  virtual ~ModbusStationModel() = default;
  /// Before each answer, and after what was written has come in. `holding`: the holding registers from
  /// address 0. The thread that answers; never blocks long, never allocates.
  virtual void follow(Time now, std::span<std::uint16_t> holding) noexcept = 0;
};

}  // namespace flexrf
