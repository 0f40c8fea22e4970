#include "hal/modbus/station/interface/modbus_station.hpp"

#include <cmath>

#include "base/nearest_name.hpp"

namespace flexrf {
namespace {

Result<std::size_t> find(const ModbusRegisterMap& map, std::string_view name, bool writing) noexcept {
  NearestName nearest(name);
  for (std::size_t i = 0; i < map.registers.size(); ++i) {
    const ModbusRegister& entry = map.registers[i];
    if (writing ? !entry.is_written() : !entry.is_read()) {
      if (entry.name != name) continue;
      return Status::error(StatusCode::not_permitted,
                           "register `%.*s` of the register map is not %s: change its access to read_write",
                           static_cast<int>(name.size()), name.data(), writing ? "written" : "read");
    }
    if (entry.name == name) return i;
    nearest.offer(entry.name);
  }
  const std::string_view best = nearest.best();
  return Status::error(StatusCode::not_found, "the register map has no register `%.*s` to %s%s%.*s%s",
                       static_cast<int>(name.size()), name.data(), writing ? "write" : "read",
                       best.empty() ? "" : "; did you mean `", static_cast<int>(best.size()), best.data(),
                       best.empty() ? "" : "`?");
}

}  // namespace

ModbusValue value_of_register(const ModbusRegister& meaning, const std::uint16_t* words,
                              const ModbusValue& scale) noexcept {
  ModbusValue result;
  if (meaning.type == ModbusType::text) {
    result.reason = NullReason::wrong_type;
    return result;
  }
  const bool is_scaled = meaning.scale_register != ModbusRegister::none;
  if (is_scaled && !scale) {
    result.reason = scale.reason;
    return result;
  }
  const double value = decode_register(meaning, words, is_scaled ? factor_of_exponent(scale.value) : 1);
  const bool is_missing = std::isnan(value);
  result.value = is_missing ? 0 : value;
  result.reason = is_missing ? NullReason::not_available : NullReason::none;
  return result;
}

ModbusText text_of_registers(const ModbusRegister& meaning, const std::uint16_t* words,
                             const ModbusValue& state) noexcept {
  ModbusText result;
  result.age = state.age;
  result.reason = meaning.type == ModbusType::text ? state.reason : NullReason::wrong_type;
  if (result) result.size = decode_text(meaning, words, result.characters).size();
  return result;
}

Result<std::size_t> ModbusStation::input(std::string_view name) const noexcept {
  return find(*registers, name, false);
}

Result<std::size_t> ModbusStation::output(std::string_view name) const noexcept {
  return find(*registers, name, true);
}

void ModbusStation::set(std::size_t index, double value) noexcept {
  if (!may_act()) return;
  if (!std::isfinite(value)) {
    fail(Status::error(StatusCode::invalid_argument, "register %zu was set to what is not a number", index));
  } else if (!outputs_.set(index, value)) {
    fail(Status::error(StatusCode::invalid_argument, "%zu is no output: ask output(name) for its index",
                       index));
  } else {
    restrain(outputs_.restraint_of(index));
  }
}

}  // namespace flexrf
