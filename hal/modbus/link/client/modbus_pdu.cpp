#include "hal/modbus/link/client/modbus_pdu.hpp"

#include <algorithm>

namespace flexrf {
namespace {

constexpr std::uint8_t refusal = 0x80;  // in the function code of an exception
constexpr std::uint16_t coil_on = 0xFF00;

bool has_bits(ModbusArea area) noexcept {
  return area == ModbusArea::coil || area == ModbusArea::discrete_input;
}

std::uint8_t reading_function(ModbusArea area) noexcept {
  switch (area) {
    case ModbusArea::coil:
      return 1;
    case ModbusArea::discrete_input:
      return 2;
    case ModbusArea::holding_register:
      return 3;
    case ModbusArea::input_register:
      break;
  }
  return 4;
}

void add(ModbusPdu& pdu, unsigned byte) noexcept {
  pdu.bytes[pdu.size++] = static_cast<std::uint8_t>(byte);
}
void add_word(ModbusPdu& pdu, unsigned word) noexcept {
  add(pdu, word >> 8U);
  add(pdu, word & 0xFFU);
}

std::size_t data_bytes(unsigned function, unsigned count) noexcept {
  return function <= 2 ? (count + 7) / 8 : 2 * std::size_t{count};
}

}  // namespace

ModbusPdu read_request(const ModbusBlock& block) noexcept {
  ModbusPdu pdu;
  add(pdu, reading_function(block.area));
  add_word(pdu, block.address);
  add_word(pdu, block.count);
  return pdu;
}

ModbusPdu write_request(const ModbusBlock& block, const std::uint16_t* words, bool multiple) noexcept {
  const bool bits = has_bits(block.area);
  ModbusPdu pdu;
  if (block.count == 1 && !multiple) {
    add(pdu, bits ? 5 : 6);
    add_word(pdu, block.address);
    add_word(pdu, !bits ? words[0] : words[0] != 0 ? coil_on : 0U);
    return pdu;
  }
  add(pdu, bits ? 15 : 16);
  add_word(pdu, block.address);
  add_word(pdu, block.count);
  if (!bits) {
    add(pdu, 2U * block.count);
    for (std::size_t i = 0; i < block.count; ++i) add_word(pdu, words[i]);
    return pdu;
  }
  add(pdu, (block.count + 7U) / 8U);
  for (std::size_t i = 0; i < block.count; i += 8) {
    unsigned byte = 0;
    for (std::size_t bit = 0; bit < 8 && i + bit < block.count; ++bit)
      byte |= (words[i + bit] != 0 ? 1U : 0U) << bit;
    add(pdu, byte);
  }
  return pdu;
}

ModbusJudgement judge_answer(const ModbusPdu& request, std::span<const std::uint8_t> answer) noexcept {
  using enum ModbusJudgement::Kind;
  const unsigned function = request.function();
  if (answer.size() < 2) return {other, 0, "it is cut short"};
  if (answer[0] == (function | refusal)) return {exception, answer[1], ""};
  if (answer[0] != function) return {other, 0, "it is to another function"};
  if (function <= 4) {
    const unsigned count = request.bytes[3] * 256U + request.bytes[4];
    const bool has_all = answer[1] == data_bytes(function, count) && answer.size() == 2U + answer[1];
    return has_all ? ModbusJudgement{}
                   : ModbusJudgement{other, 0, "it has not as many bytes as were asked for"};
  }
  // The address, and the value or the count.
  constexpr std::size_t repeated = 5;
  if (answer.size() != repeated) return {other, 0, "it is cut short"};
  if (!std::equal(answer.begin() + 1, answer.begin() + 3, request.bytes.begin() + 1))
    return {other, 0, "it confirms another address than was written"};
  if (!std::equal(answer.begin() + 3, answer.end(), request.bytes.begin() + 3))
    return {other, 0, "it confirms another value than was sent"};
  return {};
}

void take_words(const ModbusBlock& block, std::span<const std::uint8_t> answer,
                std::uint16_t* words) noexcept {
  const std::span<const std::uint8_t> data = answer.subspan(2);
  for (std::size_t i = 0; i < block.count; ++i) {
    words[i] = static_cast<std::uint16_t>(has_bits(block.area) ? data[i / 8] >> (i % 8) & 1U
                                                               : data[2 * i] * 256U + data[2 * i + 1]);
  }
}

}  // namespace flexrf
