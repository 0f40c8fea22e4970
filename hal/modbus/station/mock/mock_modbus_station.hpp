// MockModbusStation: gives the values that a test put in and records what is written.
#pragma once

#include <array>
#include <cmath>
#include <string_view>

#include "hal/driver/mock/mock_noise.hpp"
#include "hal/modbus/station/interface/modbus_station.hpp"
#include "mock_modbus_station_driver.hpp"

namespace flexrf {

/// Every register holds what was put or written last, 0 at first, and tells it in each cycle, until a test
/// says otherwise. Tests call it between cycles, from the thread the station lives in. Has no link.
class MockModbusStation final : public MockModbusStationDriver {
 public:
  enum class Fault : std::uint8_t {
    none,
    silent,        ///< nothing is read or written
    refused,       ///< likewise, by exceptions
    disconnected,  ///< likewise; and what was written is lost
  };

  Status initialise() override {
    if (registers->registers.size() > max_modbus_registers) {
      return Status::error(StatusCode::invalid_argument,
                           "the register map has %zu registers, at most %zu fit", registers->registers.size(),
                           max_modbus_registers);
    }
    begin_outputs();
    cells_ = {};
    noise_.seed(environment().seed);
    behaviour_ = Fault::none;
    return {};
  }

  ModbusValue read(std::size_t index) const noexcept override {
    const ModbusValue state = state_of(index);
    if (!is_told(index)) return state;
    const ModbusRegister& meaning = registers->registers[index];
    const bool is_scaled = meaning.scale_register != ModbusRegister::none;
    ModbusValue result = value_of_register(meaning, cells_[index].told.data(),
                                           is_scaled ? read(meaning.scale_register) : ModbusValue{});
    result.age = state.age;
    if (!state) result.reason = state.reason;
    return result;
  }
  ModbusText read_text(std::size_t index) const noexcept override {
    const ModbusValue state = state_of(index);
    if (is_told(index))
      return text_of_registers(registers->registers[index], cells_[index].told.data(), state);
    ModbusText nothing;
    nothing.reason = state.reason;
    return nothing;
  }

  // ---- for tests

  /// The register of this index holds it from now on, or tells it only `later`; not a number: it says that
  /// there is none.
  void put(std::size_t index, double value, Duration later = {}) noexcept {
    encode_register(registers->registers[index], value, cells_[index].held.data(), factor_of(index));
    cells_[index].visible_at = now_ + later;
  }
  /// The same of a text, at once.
  void put_text(std::size_t index, std::string_view text) noexcept {
    encode_text(registers->registers[index], text, cells_[index].held.data());
    cells_[index].visible_at = now_;
  }
  /// What it holds, told or not.
  double held(std::size_t index) const noexcept {
    return decode_register(registers->registers[index], cells_[index].held.data(), factor_of(index));
  }
  /// What the register of this index tells is at most so much more or less than what it holds, at random,
  /// seeded; 0 or more.
  void set_noise(std::size_t index, double most) noexcept { cells_[index].noise = most; }
  void set_fault(Fault which) noexcept {
    behaviour_ = which;
    if (which != Fault::disconnected) return;
    for (Cell& cell : cells_) cell.held = {};
  }

 private:
  struct Cell {
    std::array<std::uint16_t, ModbusRegister::most_words> held{};
    std::array<std::uint16_t, ModbusRegister::most_words> told{};
    Time visible_at{};
    Time told_at{};
    double noise = 0;
  };

  bool is_told(std::size_t index) const noexcept {
    return index < registers->registers.size() && registers->registers[index].is_read() &&
           cells_[index].told_at != Time{};
  }
  /// How old what the register tells is, or why it tells nothing.
  ModbusValue state_of(std::size_t index) const noexcept {
    ModbusValue state;
    if (index >= registers->registers.size() || !registers->registers[index].is_read()) {
      state.reason = NullReason::not_registered;
      return state;
    }
    if (!is_told(index)) {
      if (behaviour_ == Fault::refused) state.reason = NullReason::writer_faulted;
      return state;
    }
    const ModbusRegister& meaning = registers->registers[index];
    state.age = now_ - cells_[index].told_at;
    const bool is_valid = meaning.poll_group == ModbusPollGroup::once ||
                          seconds(state.age) <= period_of(meaning) + configuration.max_age;
    state.reason = is_valid                       ? NullReason::none
                   : behaviour_ == Fault::refused ? NullReason::writer_faulted
                   : behaviour_ == Fault::none    ? NullReason::too_old
                                                  : NullReason::writer_stopped;
    return state;
  }

  void take_in(const Tick& tick) noexcept override {
    now_ = tick.now;
    feedback.online = behaviour_ == Fault::none || behaviour_ == Fault::refused;
    ++feedback.requests;
    note_failure();
    if (behaviour_ != Fault::none) return;
    for (std::size_t i = 0; i < registers->registers.size(); ++i) {
      Cell& cell = cells_[i];
      const bool was_read_once =
          registers->registers[i].poll_group == ModbusPollGroup::once && cell.told_at != Time{};
      if (now_ < cell.visible_at || was_read_once) continue;
      cell.told = cell.held;
      cell.told_at = now_;
      if (cell.noise > 0 && !std::isnan(held(i)))
        encode_register(registers->registers[i], held(i) + noise_.around_zero(cell.noise), cell.told.data(),
                        factor_of(i));
    }
  }
  void write(bool /*safe*/) noexcept override {
    if (behaviour_ != Fault::none) return;
    for (std::size_t i = 0; i < registers->registers.size(); ++i) {
      if (registers->registers[i].is_written())
        encode_register(registers->registers[i], outputs()[i], cells_[i].held.data());
    }
  }
  bool is_written() const noexcept override { return behaviour_ == Fault::none; }

  void note_failure() noexcept {
    const char* cause = "";
    switch (behaviour_) {
      case Fault::none:
        return;
      case Fault::silent:
        ++feedback.timeouts;
        cause = "no answer, as the mock was asked to";
        break;
      case Fault::refused:
        ++feedback.exceptions;
        cause = "the station refuses, as the mock was asked to";
        break;
      case Fault::disconnected:
        ++feedback.lost;
        cause = "the connection was lost, as the mock was asked to";
        break;
    }
    feedback.set_last_error(cause);
  }

  // By what the scale register of this one holds.
  double factor_of(std::size_t index) const noexcept {
    const std::uint16_t scale = registers->registers[index].scale_register;
    return scale == ModbusRegister::none ? 1 : factor_of_exponent(held(scale));
  }

  double period_of(const ModbusRegister& entry) const noexcept {
    switch (entry.poll_group) {
      case ModbusPollGroup::fast:
        return configuration.fast_period;
      case ModbusPollGroup::normal:
        return configuration.normal_period;
      case ModbusPollGroup::slow:
      case ModbusPollGroup::once:
        break;
    }
    return configuration.slow_period;
  }

  std::array<Cell, max_modbus_registers> cells_{};
  Fault behaviour_ = Fault::none;
  Time now_{};
  MockNoise noise_;
};

}  // namespace flexrf
