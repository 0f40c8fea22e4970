// ModbusStation: registers that are read and written by name.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "base/status.hpp"
#include "hal/driver/actuator.hpp"
#include "hal/modbus/link/interface/register_map.hpp"
#include "hal/modbus/station/interface/station_outputs.hpp"
#include "modbus_station_interface.hpp"
#include "runtime/blackboard/item.hpp"

namespace flexrf {

/// What a register held when it was last read, or why nothing is known.
struct ModbusValue {
  double value = 0;  ///< scaled, in the register's unit; 0 or 1 for a bool
  Duration age{};    ///< since the answer came that it was in
  /// none: valid. nothing_yet: never read. Older than its poll group's period and max_age: writer_faulted
  /// when the station refuses to tell it, writer_stopped when the station does not answer, else
  /// too_old [modbus-station-1]; what is read once does not age [modbus-station-10]. not_available: the
  /// station says that it has no value, or tells a power of ten that is none; while its scale register is
  /// not valid, that one's reason [modbus-station-9].
  NullReason reason = NullReason::nothing_yet;

  explicit operator bool() const noexcept { return reason == NullReason::none; }
};

/// The text in registers, or why nothing is known.
struct ModbusText {
  std::array<char, 2 * ModbusRegister::most_words> characters{};
  std::size_t size = 0;
  Duration age{};                               ///< as of a value
  NullReason reason = NullReason::nothing_yet;  ///< likewise

  std::string_view text() const noexcept { return {characters.data(), size}; }
  explicit operator bool() const noexcept { return reason == NullReason::none; }
};

/// What the words of a register say beside their age, for drivers. `scale`: of its scale register, if it has
/// one.
ModbusValue value_of_register(const ModbusRegister& meaning, const std::uint16_t* words,
                              const ModbusValue& scale) noexcept;
/// The same of a text, with the age and the reason of its words.
ModbusText text_of_registers(const ModbusRegister& meaning, const std::uint16_t* words,
                             const ModbusValue& state) noexcept;

/// input, output: any thread, from connect() on. All else: the thread the station lives in. Made safe, it has
/// its safe values written, and says so once the station has confirmed them [modbus-station-7]; where it was
/// not heard since, they are written again, and nothing is confirmed until then [modbus-station-12].
class ModbusStation : public Actuator<ModbusStationInterface> {
 public:
  using Actuator::Actuator;

  const ModbusRegisterMap& register_map() const noexcept { return *registers; }

  /// The index of the register of this name, for read() or set(); to be asked once, in initialise(). It is an
  /// error when there is none, or when its access is not such [modbus-station-2].
  Result<std::size_t> input(std::string_view name) const noexcept;
  Result<std::size_t> output(std::string_view name) const noexcept;

  /// Never waits. An index that is no input: not_registered [modbus-station-8]; of a text: wrong_type.
  virtual ModbusValue read(std::size_t index) const noexcept = 0;
  /// Likewise, of a text; of what is none: wrong_type [modbus-station-11].
  virtual ModbusText read_text(std::size_t index) const noexcept = 0;

  /// What the register shall hold from the end of this cycle on, in its unit, until set()
  /// again [modbus-station-3]. What does not fit the register becomes the nearest that
  /// does [modbus-station-4]; what is not a number puts the station in fault [modbus-station-5]. Without
  /// effect while is_inhibited(): the safe values are written then, and what was set is
  /// forgotten [modbus-station-6].
  void set(std::size_t index, double value) noexcept;

 protected:
  /// In initialise(), by every driver: the safe values are to be written.
  void begin_outputs() noexcept { outputs_.reset(*registers); }
  /// What is to be in the station: what was set, or the safe values.
  const StationOutputs& outputs() const noexcept { return outputs_; }

 private:
  /// The outputs leave, if they are others than before. `safe`: they are the safe values.
  virtual void write(bool safe) noexcept = 0;
  /// What was written last is in the station, as far as its driver can know.
  virtual bool is_written() const noexcept = 0;

  void forget() noexcept final { outputs_.make_safe(); }
  void act(const Tick& /*tick*/) noexcept final { write(false); }
  void rest(const Tick& /*tick*/) noexcept final { write(true); }
  bool become_safe() noexcept final {
    outputs_.make_safe();
    write(true);
    return is_written();
  }

  StationOutputs outputs_;
};

}  // namespace flexrf
