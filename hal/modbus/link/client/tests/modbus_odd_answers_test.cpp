// Faulty lines and stations: the test plays the far end byte by byte, from the standard's text alone.
#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <poll.h>
#include <stdlib.h>
#include <sys/socket.h>
#include <termios.h>
#include <unistd.h>

#include <atomic>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "hal/modbus/link/client/modbus_client.hpp"
#include "runtime/executive/tests/checks.hpp"

namespace flexrf {
namespace {

using Bytes = std::vector<std::uint8_t>;
/// Makes the bytes that the far end sends for a request.
using Answer = std::function<Bytes(const Bytes&)>;

/// The far end answers at once; a busy machine lets it wait.
constexpr Duration response_timeout = std::chrono::seconds(10);
constexpr std::uint8_t unit = 9;

/// Modbus over serial line V1.02, 6.2.2.
Bytes with_crc(Bytes frame) {
  unsigned crc = 0xFFFF;
  for (const std::uint8_t byte : frame) {
    crc ^= byte;
    for (int bit = 0; bit < 8; ++bit) crc = (crc & 1U) != 0 ? (crc >> 1U) ^ 0xA001U : crc >> 1U;
  }
  frame.push_back(static_cast<std::uint8_t>(crc & 0xFFU));
  frame.push_back(static_cast<std::uint8_t>(crc >> 8U));
  return frame;
}

/// A thread that reads requests from a descriptor and writes what comes back.
class FarEnd {
 public:
  virtual ~FarEnd() = default;
  /// The function code of each request on a serial line, in their order.
  Bytes functions() {
    const std::lock_guard lock(mutex_);
    return functions_;
  }

 protected:
  void begin(int descriptor, Answer answer) {
    descriptor_ = descriptor;
    answer_ = std::move(answer);
    thread_ = std::thread([this] { run(); });
  }
  void end() {
    over_ = true;
    if (thread_.joinable()) thread_.join();
    if (descriptor_ >= 0) close(descriptor_);
    descriptor_ = -1;
  }

 private:
  void run() {
    while (!over_) {
      pollfd waits{descriptor_, POLLIN, 0};
      if (poll(&waits, 1, 10) <= 0) continue;
      std::uint8_t buffer[300];
      const ssize_t size = read(descriptor_, buffer, sizeof(buffer));
      if (size <= 0) continue;
      {
        const std::lock_guard lock(mutex_);
        functions_.push_back(buffer[1]);
      }
      const Bytes back = answer_(Bytes(buffer, buffer + size));
      CHECK(back.empty() ||
            write(descriptor_, back.data(), back.size()) == static_cast<ssize_t>(back.size()));
    }
  }

  int descriptor_ = -1;
  Answer answer_;
  std::atomic<bool> over_{false};
  std::mutex mutex_;
  Bytes functions_;
  std::thread thread_;
};

class SerialFarEnd final : public FarEnd {
 public:
  explicit SerialFarEnd(Answer answer, Duration timeout = response_timeout) {
    const int line = posix_openpt(O_RDWR | O_NOCTTY);
    char path[64] = "";
    CHECK(line >= 0 && grantpt(line) == 0 && unlockpt(line) == 0 && ptsname_r(line, path, sizeof(path)) == 0);
    CHECK(client.use_rtu({path, 115200, 'N', 2}, timeout));
    CHECK(client.open());
    begin(line, std::move(answer));
  }
  ~SerialFarEnd() override {
    client.close();
    end();
  }
  ModbusClient client;
};

class TcpFarEnd final : public FarEnd {
 public:
  explicit TcpFarEnd(Answer answer) {
    const int listener = socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof(address);
    CHECK(bind(listener, reinterpret_cast<sockaddr*>(&address), size) == 0 && listen(listener, 1) == 0);
    CHECK(getsockname(listener, reinterpret_cast<sockaddr*>(&address), &size) == 0);
    CHECK(client.use_tcp("127.0.0.1", ntohs(address.sin_port), response_timeout));
    CHECK(client.open());
    const int connection = accept(listener, nullptr, nullptr);
    close(listener);
    CHECK(connection >= 0);
    begin(connection, std::move(answer));
  }
  ~TcpFarEnd() override {
    client.close();
    end();
  }
  ModbusClient client;
};

ModbusBlock block_of(ModbusArea area, int address, int count = 1) {
  ModbusBlock block;
  block.area = area;
  block.address = static_cast<std::uint16_t>(address);
  block.count = static_cast<std::uint16_t>(count);
  return block;
}
const ModbusBlock setting = block_of(ModbusArea::holding_register, 20);
constexpr std::uint16_t value[] = {3};
constexpr std::uint16_t several_values[] = {3, 4, 5};

Bytes own_echo(const Bytes& request) {
  return request;
}
/// Unit and data, without the checksum, of a request on a serial line.
Bytes confirmed(const Bytes& request) {
  return with_crc(Bytes(request.begin(), request.begin() + 6));
}
Bytes refused(const Bytes& request, std::uint8_t code) {
  return with_crc({request[0], static_cast<std::uint8_t>(request[1] | 0x80U), code});
}

// With nobody on the line, or everybody.
// [modbus-transport-2]
void a_line_that_hears_itself_confirms_nothing() {
  for (const ModbusBlock& block :
       {setting, block_of(ModbusArea::coil, 7), block_of(ModbusArea::holding_register, 0x0305),
        block_of(ModbusArea::holding_register, 20, 3)}) {
    SerialFarEnd far(own_echo);
    std::uint16_t words[3] = {};
    for (int i = 0; i < 3; ++i) {
      const ModbusReply written = far.client.write(unit, block, several_values, false);
      CHECK(written.outcome == ModbusOutcome::bad_reply);
      CHECK_CONTAINS(written.cause, "the line hears itself");
      far.client.resynchronise();
    }
    const ModbusReply read = far.client.read(unit, block, words);
    CHECK(read.outcome == ModbusOutcome::bad_reply);
    CHECK_CONTAINS(read.cause, "the line hears itself");
  }
}

// [modbus-transport-2]
void a_line_that_hears_itself_and_its_station_confirms_nothing() {
  SerialFarEnd far([](const Bytes& request) {
    Bytes both = request;
    const Bytes answer = confirmed(request);
    both.insert(both.end(), answer.begin(), answer.end());
    return both;
  });
  const ModbusReply written = far.client.write(unit, setting, value, false);
  CHECK(written.outcome == ModbusOutcome::bad_reply);
  CHECK_CONTAINS(written.cause, "the line hears itself");
}

// After the first answer it is known that the line does not hear itself.
void the_function_for_one_is_used_on_a_line_that_somebody_has_answered() {
  SerialFarEnd far(confirmed);
  for (int i = 0; i < 3; ++i)
    CHECK(far.client.write(unit, setting, value, false).outcome == ModbusOutcome::answered);
  CHECK(far.functions() == (Bytes{16, 6, 6}));
  far.client.close();
  CHECK(far.client.open());
  CHECK(far.client.write(unit, setting, value, false).outcome == ModbusOutcome::answered);
  CHECK_EQUAL(far.functions().back(), 16);
}

void a_station_that_knows_the_function_for_one_alone_is_written_to() {
  SerialFarEnd far(
      [](const Bytes& request) { return request[1] == 6 ? confirmed(request) : refused(request, 1); });
  const ModbusReply first = far.client.write(unit, setting, value, false);
  CHECK(first.outcome == ModbusOutcome::exception);
  CHECK(!first.is_of_unknown_function());  // of the one that was asked for it is not known
  CHECK(far.client.write(unit, setting, value, false).outcome == ModbusOutcome::answered);
  // One that answers nothing but what it knows.
  SerialFarEnd silent([](const Bytes& request) { return request[1] == 6 ? confirmed(request) : Bytes{}; },
                      std::chrono::seconds(1));
  CHECK(silent.client.write(unit, setting, value, false).outcome == ModbusOutcome::timeout);
  CHECK(silent.client.write(unit, setting, value, false).outcome == ModbusOutcome::answered);
}

// Its first bytes are those of the request, as the standard has it, and its checksum is wrong.
void a_damaged_confirmation_is_no_echo() {
  for (const ModbusBlock& block : {setting, block_of(ModbusArea::holding_register, 20, 3)}) {
    std::atomic<bool> is_damaged{false};
    SerialFarEnd far([&is_damaged](const Bytes& request) {
      Bytes answer = confirmed(request);
      if (is_damaged) answer.back() = static_cast<std::uint8_t>(answer.back() ^ 0x01U);
      return answer;
    });
    CHECK(far.client.write(unit, block, several_values, false).outcome == ModbusOutcome::answered);
    is_damaged = true;
    const ModbusReply reply = far.client.write(unit, block, several_values, false);
    CHECK(reply.outcome == ModbusOutcome::bad_reply);
    CHECK_CONTAINS(reply.cause, "the answer is damaged");
  }
}

void a_function_that_is_not_known_is_told_as_that() {
  SerialFarEnd far([](const Bytes& request) { return refused(request, request[1] == 3 ? 2 : 1); });
  std::uint16_t words[1] = {};
  const ModbusReply read = far.client.read(unit, setting, words);
  CHECK(read.outcome == ModbusOutcome::exception);
  CHECK_EQUAL(read.exception, 2);
  CHECK_CONTAINS(read.cause, "is the register map that of this station?");
  const ModbusReply written = far.client.write(unit, setting, value, false);
  CHECK(written.is_of_unknown_function());
  CHECK(far.client.write(unit, setting, value, true).is_of_unknown_function());
}

/// An answer over TCP to this request: its header, with what `change` makes of the rest.
Bytes over_tcp(const Bytes& request, Bytes rest) {
  Bytes answer(request.begin(), request.begin() + 4);
  answer.push_back(static_cast<std::uint8_t>(rest.size() >> 8U));
  answer.push_back(static_cast<std::uint8_t>(rest.size() & 0xFFU));
  answer.insert(answer.end(), rest.begin(), rest.end());
  return answer;
}

// [modbus-transport-1]
void an_answer_over_tcp_has_to_be_this_requests() {
  struct Case {
    const char* told;
    Answer answer;
  };
  const Case cases[] = {
      {"it confirms another value than was sent",
       [](const Bytes& r) {
         return over_tcp(r, {r[6], r[7], r[8], r[9], r[10], 0x55});
       }},
      {"it confirms another address than was written",
       [](const Bytes& r) {
         return over_tcp(r, {r[6], r[7], r[8], 0x55, r[10], r[11]});
       }},
      {"an answer of unit 10 came",
       [](const Bytes& r) {
         return over_tcp(r, {10, r[7], r[8], r[9], r[10], r[11]});
       }},
      {"it is to another function",
       [](const Bytes& r) {
         return over_tcp(r, {r[6], 5, r[8], r[9], r[10], r[11]});
       }},
      {"the answer is to another request",
       [](const Bytes& r) {
         Bytes answer = over_tcp(r, {r[6], r[7], r[8], r[9], r[10], r[11]});
         answer[1] = static_cast<std::uint8_t>(answer[1] + 1);
         return answer;
       }},
      {"the answer's header is none of Modbus TCP",
       [](const Bytes& r) {
         Bytes answer = over_tcp(r, {r[6], r[7], r[8], r[9], r[10], r[11]});
         answer[2] = 1;
         return answer;
       }},
      {"or tells another length",
       [](const Bytes& r) {
         return over_tcp(r, {r[6], r[7], r[8], r[9], r[10], r[11], 0});
       }},
  };
  for (const Case& one : cases) {
    TcpFarEnd far(one.answer);
    const ModbusReply reply = far.client.write(unit, setting, value, false);
    CHECK(reply.outcome == ModbusOutcome::bad_reply);
    CHECK_CONTAINS(reply.cause, one.told);
  }
  TcpFarEnd well([](const Bytes& r) { return over_tcp(r, {r[6], r[7], r[8], r[9], r[10], r[11]}); });
  for (int i = 0; i < 3; ++i)
    CHECK(well.client.write(unit, setting, value, false).outcome == ModbusOutcome::answered);
}

// [modbus-transport-1]
void a_reading_of_another_unit_is_none() {
  std::uint16_t words[1] = {77};
  TcpFarEnd far([](const Bytes& r) { return over_tcp(r, {10, r[7], 2, 0x12, 0x34}); });
  const ModbusReply reply = far.client.read(unit, setting, words);
  CHECK(reply.outcome == ModbusOutcome::bad_reply);
  CHECK_EQUAL(words[0], 77);
  TcpFarEnd well([](const Bytes& r) { return over_tcp(r, {r[6], r[7], 2, 0x12, 0x34}); });
  CHECK(well.client.read(unit, setting, words).outcome == ModbusOutcome::answered);
  CHECK_EQUAL(words[0], 0x1234);
}

// More than one request's transactions: their number goes round.
void transactions_go_round() {
  TcpFarEnd well([](const Bytes& r) { return over_tcp(r, {r[6], r[7], 2, r[0], r[1]}); });
  std::uint16_t words[1] = {};
  std::uint16_t last = 0;
  for (int i = 0; i < 300; ++i) {
    CHECK(well.client.read(unit, setting, words).outcome == ModbusOutcome::answered);
    CHECK(words[0] != last);
    last = words[0];
  }
}

void an_exception_that_the_standard_does_not_have_is_told_with_its_number() {
  TcpFarEnd far([](const Bytes& r) {
    return over_tcp(r, {r[6], static_cast<std::uint8_t>(r[7] | 0x80U), 0xAB});
  });
  std::uint16_t words[1] = {};
  const ModbusReply reply = far.client.read(unit, setting, words);
  CHECK(reply.outcome == ModbusOutcome::exception);
  CHECK_CONTAINS(reply.cause, "exception 171, which the standard does not have");
}

}  // namespace
}  // namespace flexrf

int main() {
  using namespace flexrf;
  const CMUnitTest tests[] = {
      CONTAINED_TEST(a_line_that_hears_itself_confirms_nothing),
      CONTAINED_TEST(a_line_that_hears_itself_and_its_station_confirms_nothing),
      CONTAINED_TEST(the_function_for_one_is_used_on_a_line_that_somebody_has_answered),
      CONTAINED_TEST(a_station_that_knows_the_function_for_one_alone_is_written_to),
      CONTAINED_TEST(a_damaged_confirmation_is_no_echo),
      CONTAINED_TEST(a_function_that_is_not_known_is_told_as_that),
      CONTAINED_TEST(an_answer_over_tcp_has_to_be_this_requests),
      CONTAINED_TEST(a_reading_of_another_unit_is_none),
      CONTAINED_TEST(transactions_go_round),
      CONTAINED_TEST(an_exception_that_the_standard_does_not_have_is_told_with_its_number),
  };
  return cmocka_run_group_tests_name("Modbus: odd answers", tests, nullptr, nullptr);
}
