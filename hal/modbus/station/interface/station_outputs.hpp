// What a unit wants written, or the safe values while it may not.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "hal/modbus/link/interface/register_map.hpp"
#include "runtime/unit/restraint.hpp"

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
  /// What was set at a valid index does not fit its register, which holds the nearest that does; none: it
  /// fits.
  Restraint restraint_of(std::size_t index) const noexcept {
    const ModbusRegister& meaning = map_->registers[index];
    const double asked = values_[index];
    std::uint16_t words[4] = {};
    encode_register(meaning, asked, words);
    const double held = decode_register(meaning, words);
    // What is rounded to the register's counts, or to a float, fits.
    const double rounding =
        std::max(std::abs(meaning.scale), 1e-6 * std::max(std::abs(asked), std::abs(meaning.offset)));
    if (std::abs(held - asked) <= rounding) return {};
    return {"a value that its register cannot hold is kept to the nearest that it can", asked, held};
  }
  double operator[](std::size_t index) const noexcept { return values_[index]; }

 private:
  const ModbusRegisterMap* map_ = nullptr;
  std::array<double, max_modbus_registers> values_{};
};

}  // namespace flexrf
