// What passes between a link's thread and that of a station.
#pragma once

#include <array>
#include <atomic>
#include <vector>

#include "hal/modbus/link/interface/modbus_plan.hpp"
#include "runtime/blackboard/ports.hpp"
#include "types/modbus_command.hpp"
#include "types/modbus_image.hpp"

namespace flexrf {

struct ModbusStationSetup {
  const char* name = "";                   ///< of the device, for messages; outlives the link
  const ModbusRegisterMap* map = nullptr;  ///< likewise
  std::uint8_t unit_id = 1;
  std::array<Duration, 3> poll_periods{};  ///< by poll group but `once`; 0: in every cycle of the link
  Duration refresh_period{};               ///< what did not change is written again; 0: never
  bool writes_multiple = false;  ///< single values by the functions for several; else until it knows no other
  std::uint16_t most_registers = 125;  ///< of a request
  /// Of what would move by itself if it were told again what it was told before it was switched off: nothing
  /// is written before it has answered, and after it was not heard only what is commanded anew. Whether it is
  /// safe it knows itself.
  bool listens_first = false;
};

/// Made when a station registers, kept for the link's life and used again for the next that registers, so
/// that the link's thread never meets one that is gone.
struct ModbusExchange {
  enum class State : std::uint8_t {
    free,
    active,
    leaving,  ///< the station has gone; the link's thread makes it free
  };
  std::atomic<State> state{State::free};

  // Written by the lifecycle thread while free, as is all else then; read by both sides while active.
  ModbusStationSetup setup;
  ModbusPlan plan;

  Slot<ModbusCommand, 1> command_slot;
  Slot<ModbusImage, 1> image_slot;

  // The station's side.
  Output<ModbusCommand> commands;
  SlotReader images{&image_slot.control()};

  // The link's side.
  struct LinkSide {
    ModbusImage image{};
    bool touched = false;  ///< the image is to be published
    bool safe = false;     ///< the last command that was written as a whole was the safe values
    std::array<std::uint16_t, max_modbus_output_words> sent{};
    std::vector<bool> written;    ///< per write: sent is what the station has
    std::vector<Time> write_due;  ///< per write: not before, or again
    std::vector<Time> read_due;   ///< per read
    std::size_t next_write = 0;   ///< where a turn that ran out of time goes on; reads_first: with the reads
    std::size_t next_read = 0;
    bool reads_first = false;
    std::uint64_t stale = 0;  ///< of who listens first: commands up to this are not for it
    Time retry_at{};
    std::uint32_t failures = 0;        ///< in a row; of readings, where it is read
    Time write_at{};                   ///< what is written, if that failed: not before
    std::uint32_t write_failures = 0;  ///< in a row
    bool safe_has_failed = false;      ///< the last of them were safe values: new ones do not wait
    bool writes_multiple = false;      ///< single values: which functions the station was found to know
  };
  LinkSide link;
  SlotReader command_reader{&command_slot.control()};
  Output<ModbusImage> image_output;

  ModbusExchange() noexcept {
    commands.connect(nullptr, &command_slot.control());
    image_output.connect(nullptr, &image_slot.control());
  }
};

}  // namespace flexrf
