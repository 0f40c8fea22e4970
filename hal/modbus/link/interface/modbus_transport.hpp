// What a link's driver brings: one request at a time, and its outcome.
#pragma once

#include <cstdint>

#include "base/status.hpp"
#include "base/time.hpp"
#include "hal/modbus/link/interface/modbus_plan.hpp"

namespace flexrf {

enum class ModbusOutcome : std::uint8_t {
  answered,
  exception,    ///< the station refuses: the link is well
  unreachable,  ///< a gateway tells that it did not get through to the station: the link is well
  timeout,      ///< no whole answer in time
  bad_reply,    ///< damaged, cut, or not to this request
  lost,         ///< the connection or the line is gone
};

struct ModbusReply {
  ModbusOutcome outcome = ModbusOutcome::answered;
  const char* cause = "";      ///< in words, of what is not answered; valid until the next request
  std::uint8_t exception = 0;  ///< its code (Modbus Application Protocol V1.1b3, 7); 0: there is none

  bool is_of_unknown_function() const noexcept { return exception == 1; }
};

/// A request is answered by what is its answer alone: to this request, of this unit, with its function and as
/// many values as were asked for, and of a write with the address and the value (or count) that were sent
/// [modbus-transport-1]. What the line itself sends back is none [modbus-transport-2].
///
/// All in the link's thread.
class ModbusTransport {
 public:
  virtual ~ModbusTransport() = default;
  /// May wait as long as the response timeout.
  virtual Status open() noexcept = 0;
  virtual void close() noexcept = 0;
  virtual bool is_open() const noexcept = 0;
  /// `words`: block.count of them, a bit in each for bits. May wait for as long as longest_wait() says.
  virtual ModbusReply read(std::uint8_t unit_id, const ModbusBlock& block, std::uint16_t* words) noexcept = 0;
  /// `multiple`: a single one, too, by the functions that write several (15 and 16).
  virtual ModbusReply write(std::uint8_t unit_id, const ModbusBlock& block, const std::uint16_t* words,
                            bool multiple) noexcept = 0;
  /// How long a request of it may keep the link's thread; 0 where none does. Any thread.
  virtual Duration longest_wait(const ModbusBlock& block, bool writes) const noexcept = 0;
  /// After a timeout or a bad reply: whatever still comes must not be taken for the next answer. May close.
  virtual void resynchronise() noexcept = 0;
  /// The clock by which answers are stamped: it moves while a request waits.
  virtual Time now() const noexcept = 0;
};

}  // namespace flexrf
