// What a unit wants written, or the safe values while it may not.
#pragma once

#include <array>

#include "hal/interfaces/modbus_link/register_map.hpp"

namespace flexrf {

class StationOutputs {
 public:
  void reset(const ModbusRegisterMap& map) noexcept {
    map_ = &map;
    make_safe();
  }
  void make_safe() noexcept {
    for (std::size_t i = 0; i < map_->registers.size(); ++i) values_[i] = map_->registers[i].safe_value;
  }
  /// False when there is no such output.
  bool set(std::size_t index, double value) noexcept {
    if (index >= map_->registers.size() || !map_->registers[index].is_written()) return false;
    values_[index] = value;
    return true;
  }
  double operator[](std::size_t index) const noexcept { return values_[index]; }

 private:
  const ModbusRegisterMap* map_ = nullptr;
  std::array<double, max_modbus_registers> values_{};
};

}  // namespace flexrf
