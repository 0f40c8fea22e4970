// Requests and answers, byte by byte as in the examples of the Modbus Application Protocol V1.1b3.
#include "hal/modbus/link/client/modbus_pdu.hpp"

#include <string>
#include <vector>

#include "runtime/executive/tests/checks.hpp"

namespace flexrf {
namespace {

using Bytes = std::vector<std::uint8_t>;

ModbusBlock block_of(ModbusArea area, int address, int count) {
  ModbusBlock block;
  block.area = area;
  block.address = static_cast<std::uint16_t>(address);
  block.count = static_cast<std::uint16_t>(count);
  return block;
}
Bytes bytes_of(const ModbusPdu& pdu) {
  return {pdu.bytes.begin(), pdu.bytes.begin() + static_cast<std::ptrdiff_t>(pdu.size)};
}
bool fits(const ModbusPdu& request, const Bytes& answer) {
  return judge_answer(request, answer).kind == ModbusJudgement::Kind::fits;
}
std::string why(const ModbusPdu& request, const Bytes& answer) {
  const ModbusJudgement judgement = judge_answer(request, answer);
  CHECK(judgement.kind == ModbusJudgement::Kind::other);
  return judgement.why;
}

// 6.1, 6.3: coils 20 to 38, registers 108 to 110.
void readings_are_those_of_the_standard() {
  const ModbusBlock coils = block_of(ModbusArea::coil, 0x13, 0x13);
  CHECK(bytes_of(read_request(coils)) == (Bytes{0x01, 0x00, 0x13, 0x00, 0x13}));
  const Bytes of_coils = {0x01, 0x03, 0xCD, 0x6B, 0x05};
  CHECK(fits(read_request(coils), of_coils));
  std::array<std::uint16_t, 19> bits{};
  take_words(coils, of_coils, bits.data());
  CHECK(bits == (std::array<std::uint16_t, 19>{1, 0, 1, 1, 0, 0, 1, 1, 1, 1, 0, 1, 0, 1, 1, 0, 1, 0, 1}));

  const ModbusBlock registers = block_of(ModbusArea::holding_register, 0x6B, 3);
  CHECK(bytes_of(read_request(registers)) == (Bytes{0x03, 0x00, 0x6B, 0x00, 0x03}));
  const Bytes of_registers = {0x03, 0x06, 0x02, 0x2B, 0x00, 0x00, 0x00, 0x64};
  CHECK(fits(read_request(registers), of_registers));
  std::array<std::uint16_t, 3> words{};
  take_words(registers, of_registers, words.data());
  CHECK(words == (std::array<std::uint16_t, 3>{555, 0, 100}));

  CHECK(bytes_of(read_request(block_of(ModbusArea::discrete_input, 0xC4, 0x16))) ==
        (Bytes{0x02, 0x00, 0xC4, 0x00, 0x16}));
  CHECK(bytes_of(read_request(block_of(ModbusArea::input_register, 8, 1))) ==
        (Bytes{0x04, 0x00, 0x08, 0x00, 0x01}));
}

// 6.5, 6.6, 6.11, 6.12.
void writings_are_those_of_the_standard() {
  const std::uint16_t one[] = {3};
  const ModbusBlock coil = block_of(ModbusArea::coil, 0xAC, 1);
  CHECK(bytes_of(write_request(coil, one, false)) == (Bytes{0x05, 0x00, 0xAC, 0xFF, 0x00}));
  CHECK(bytes_of(write_request(coil, one, true)) == (Bytes{0x0F, 0x00, 0xAC, 0x00, 0x01, 0x01, 0x01}));
  const std::uint16_t zero[] = {0};
  CHECK(bytes_of(write_request(coil, zero, false)) == (Bytes{0x05, 0x00, 0xAC, 0x00, 0x00}));

  const ModbusBlock single = block_of(ModbusArea::holding_register, 1, 1);
  CHECK(bytes_of(write_request(single, one, false)) == (Bytes{0x06, 0x00, 0x01, 0x00, 0x03}));
  CHECK(bytes_of(write_request(single, one, true)) ==
        (Bytes{0x10, 0x00, 0x01, 0x00, 0x01, 0x02, 0x00, 0x03}));

  const std::uint16_t ten[] = {1, 0, 1, 1, 0, 0, 1, 1, 1, 0};
  const ModbusPdu coils = write_request(block_of(ModbusArea::coil, 0x13, 10), ten, false);
  CHECK(bytes_of(coils) == (Bytes{0x0F, 0x00, 0x13, 0x00, 0x0A, 0x02, 0xCD, 0x01}));
  CHECK(fits(coils, {0x0F, 0x00, 0x13, 0x00, 0x0A}));

  const std::uint16_t two[] = {0x0A, 0x0102};
  const ModbusPdu registers = write_request(block_of(ModbusArea::holding_register, 1, 2), two, false);
  CHECK(bytes_of(registers) == (Bytes{0x10, 0x00, 0x01, 0x00, 0x02, 0x04, 0x00, 0x0A, 0x01, 0x02}));
  CHECK(fits(registers, {0x10, 0x00, 0x01, 0x00, 0x02}));
}

void the_largest_fit() {
  std::vector<std::uint16_t> words(1968, 1);
  CHECK_EQUAL(write_request(block_of(ModbusArea::coil, 0, 1968), words.data(), false).size, 6U + 246U);
  CHECK_EQUAL(write_request(block_of(ModbusArea::holding_register, 0, 123), words.data(), false).size,
              6U + 246U);
}

// [modbus-transport-1]
void an_answer_that_confirms_something_else_is_none() {
  const std::uint16_t words[] = {3, 4};
  const ModbusPdu single = write_request(block_of(ModbusArea::holding_register, 1, 1), words, false);
  CHECK(fits(single, {0x06, 0x00, 0x01, 0x00, 0x03}));
  CHECK_EQUAL(why(single, {0x06, 0x00, 0x01, 0x00, 0x04}),
              std::string("it confirms another value than was sent"));
  CHECK_EQUAL(why(single, {0x06, 0x00, 0x02, 0x00, 0x03}),
              std::string("it confirms another address than was written"));
  CHECK_EQUAL(why(single, {0x05, 0x00, 0x01, 0x00, 0x03}), std::string("it is to another function"));
  CHECK_EQUAL(why(single, {0x06, 0x00, 0x01, 0x00}), std::string("it is cut short"));
  const ModbusPdu several = write_request(block_of(ModbusArea::holding_register, 1, 2), words, false);
  CHECK_EQUAL(why(several, {0x10, 0x00, 0x01, 0x00, 0x01}),
              std::string("it confirms another value than was sent"));
  const ModbusPdu reading = read_request(block_of(ModbusArea::holding_register, 1, 2));
  CHECK_EQUAL(why(reading, {0x03, 0x02, 0x00, 0x01}),
              std::string("it has not as many bytes as were asked for"));
  CHECK_EQUAL(why(reading, {0x03, 0x04, 0x00, 0x01}),
              std::string("it has not as many bytes as were asked for"));
  CHECK_EQUAL(why(reading, {0x03}), std::string("it is cut short"));
  CHECK_EQUAL(why(reading, {}), std::string("it is cut short"));
}

// 7
void an_exception_is_told_with_its_code() {
  const ModbusPdu reading = read_request(block_of(ModbusArea::coil, 0x04A1, 1));
  const ModbusJudgement judgement = judge_answer(reading, Bytes{0x81, 0x02});
  CHECK(judgement.kind == ModbusJudgement::Kind::exception);
  CHECK_EQUAL(judgement.exception, 2);
  CHECK_EQUAL(why(reading, {0x83, 0x02}), std::string("it is to another function"));
}

}  // namespace
}  // namespace flexrf

int main() {
  using namespace flexrf;
  const CMUnitTest tests[] = {
      CONTAINED_TEST(readings_are_those_of_the_standard),
      CONTAINED_TEST(writings_are_those_of_the_standard),
      CONTAINED_TEST(the_largest_fit),
      CONTAINED_TEST(an_answer_that_confirms_something_else_is_none),
      CONTAINED_TEST(an_exception_is_told_with_its_code),
  };
  return cmocka_run_group_tests_name("Modbus requests and answers", tests, nullptr, nullptr);
}
