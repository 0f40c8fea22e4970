// Modbus requests and answers without their frames: function code and data (Modbus Application Protocol
// V1.1b3).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "hal/modbus/link/interface/modbus_plan.hpp"

namespace flexrf {

struct ModbusPdu {
  static constexpr std::size_t most = 253;  ///< bytes (4.1)
  std::array<std::uint8_t, most> bytes{};
  std::size_t size = 0;

  std::uint8_t function() const noexcept { return bytes[0]; }
  /// Its answer repeats all of it, so that it cannot be told from the request itself: functions 5 and 6.
  bool is_answered_by_itself() const noexcept { return function() == 5 || function() == 6; }
};

/// Functions 1 to 4 (6.1 to 6.4).
ModbusPdu read_request(const ModbusBlock& block) noexcept;
/// A block of one by function 5 or 6 (6.5, 6.6), unless it is `multiple`; else by 15 or 16 (6.11, 6.12).
/// `words`: block.count of them, a bit in each for bits.
ModbusPdu write_request(const ModbusBlock& block, const std::uint16_t* words, bool multiple) noexcept;

/// Whether an answer belongs to a request.
struct ModbusJudgement {
  enum class Kind : std::uint8_t { fits, exception, other };
  Kind kind = Kind::fits;
  std::uint8_t exception = 0;  ///< its code (7)
  const char* why = "";        ///< it is another's, in words
};

/// An answer fits when it has the request's function, as many bytes as were asked for, and of a write the
/// address and value (or count) that were sent.
ModbusJudgement judge_answer(const ModbusPdu& request, std::span<const std::uint8_t> answer) noexcept;

/// The words in an answer that fits a read_request() of this block.
void take_words(const ModbusBlock& block, std::span<const std::uint8_t> answer,
                std::uint16_t* words) noexcept;

}  // namespace flexrf
