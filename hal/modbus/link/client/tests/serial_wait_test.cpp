// How long an answer is waited for on a serial line: as long as the station has, and as the line takes.
#include <fcntl.h>
#include <stdlib.h>
#include <unistd.h>

#include <cmath>
#include <cstring>

#include "hal/modbus/link/client/modbus_client.hpp"
#include "runtime/executive/tests/checks.hpp"

namespace flexrf {
namespace {

constexpr Duration response_timeout = std::chrono::milliseconds(50);

ModbusBlock block_of(ModbusArea area, std::uint16_t count) {
  ModbusBlock block;
  block.area = area;
  block.count = count;
  return block;
}

// Beside the station's time and the silence before the request, in characters of the line.
double characters(const ModbusBlock& block, bool writes, char parity, std::uint8_t stop_bits, int bits) {
  ModbusClient client;
  CHECK(client.use_rtu({"/dev/null", 1200, parity, stop_bits}, response_timeout));
  const double silence = 3.5 * bits / 1200;
  return (seconds(client.longest_wait(block, writes) - response_timeout) - silence) * 1200 / bits;
}

void it_is_what_request_and_answer_take_on_the_line() {
  const auto of = [](ModbusArea area, std::uint16_t count, bool writes) {
    return std::lround(characters(block_of(area, count), writes, 'E', 1, 11));
  };
  // The largest of each, and single ones: their frames as the standard has them, unit id and CRC included.
  CHECK_EQUAL(of(ModbusArea::holding_register, 125, false), 8 + 255);
  CHECK_EQUAL(of(ModbusArea::input_register, 1, false), 8 + 7);
  CHECK_EQUAL(of(ModbusArea::coil, 2000, false), 8 + 255);
  CHECK_EQUAL(of(ModbusArea::discrete_input, 9, false), 8 + 7);
  CHECK_EQUAL(of(ModbusArea::holding_register, 123, true), 255 + 8);
  CHECK_EQUAL(of(ModbusArea::coil, 1968, true), 255 + 8);
  // A single one by the longer of its functions.
  CHECK_EQUAL(of(ModbusArea::holding_register, 1, true), 11 + 8);
  const ModbusBlock one = block_of(ModbusArea::holding_register, 1);
  CHECK_EQUAL(std::lround(characters(one, true, 'N', 1, 10)), 19);
  CHECK_EQUAL(std::lround(characters(one, true, 'N', 2, 11)), 19);
  CHECK_EQUAL(std::lround(characters(one, true, 'O', 2, 12)), 19);
}

void over_tcp_it_is_the_stations_alone() {
  ModbusClient client;
  CHECK(client.use_tcp("127.0.0.1", 502, response_timeout));
  CHECK(client.longest_wait(block_of(ModbusArea::holding_register, 125), false) == response_timeout);
}

// 125 registers take 0.301 s at 9600 bit/s, and an answer of 0.05 s could not have come in that time.
void an_answer_is_given_the_time_that_the_line_takes() {
  const int station = posix_openpt(O_RDWR | O_NOCTTY);
  CHECK(station >= 0 && grantpt(station) == 0 && unlockpt(station) == 0);
  char path[64] = "";
  CHECK(ptsname_r(station, path, sizeof(path)) == 0);
  ModbusClient client;
  CHECK(client.use_rtu({path, 9600, 'E', 1}, response_timeout));
  CHECK(client.open());
  std::array<std::uint16_t, 125> words{};
  const Time asked = client.now();
  const ModbusReply reply = client.read(1, block_of(ModbusArea::holding_register, 125), words.data());
  // Nobody answers: it was waited for long enough.
  CHECK(reply.outcome == ModbusOutcome::timeout);
  CHECK(client.now() - asked >= std::chrono::milliseconds(350));
  CHECK_EQUAL(std::string(reply.cause),
              std::string("no whole answer within 0.351 s; is the station on, and its unit id right?"));
  client.close();
  close(station);
}

}  // namespace
}  // namespace flexrf

int main() {
  using namespace flexrf;
  const CMUnitTest tests[] = {
      CONTAINED_TEST(it_is_what_request_and_answer_take_on_the_line),
      CONTAINED_TEST(over_tcp_it_is_the_stations_alone),
      CONTAINED_TEST(an_answer_is_given_the_time_that_the_line_takes),
  };
  return cmocka_run_group_tests_name("Modbus: waiting on a serial line", tests, nullptr, nullptr);
}
