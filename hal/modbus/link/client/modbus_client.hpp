// Requests through libmodbus, over TCP or a serial line.
#pragma once

#include <array>
#include <cstdint>

#include "hal/modbus/link/client/modbus_pdu.hpp"
#include "hal/modbus/link/interface/modbus_transport.hpp"

struct _modbus;

namespace flexrf {

/// Settings: lifecycle thread. All else: the link's thread. Waits for answers, for at most longest_wait()
/// each; libmodbus' own recovery, which sleeps, stays off. libmodbus carries requests and answers; whether an
/// answer is this request's is judged here: by its transaction, its unit id and its content, since libmodbus
/// takes any unit's over TCP, and any value as the confirmation of a write.
///
/// An RS-485 adapter may echo what it sends, and the answer to function 5 or 6 is the request itself. So the
/// first single value on a serial line is written by function 15 or 16: the echo of that request is not its
/// answer, and gives an error.
class ModbusClient final : public ModbusTransport {
 public:
  ModbusClient() = default;
  ModbusClient(const ModbusClient&) = delete;
  ModbusClient& operator=(const ModbusClient&) = delete;
  ~ModbusClient() override;

  /// `address` is numeric, as 192.168.1.20: names would have to be looked up, which may take any time.
  Status use_tcp(const char* address, std::uint16_t port, Duration response_timeout);
  struct SerialLine {
    const char* device = "";
    std::uint32_t baud = 19200;
    char parity = 'E';  ///< N, E or O
    std::uint8_t stop_bits = 1;
  };
  /// The timeout is the station's alone: what request and answer take on the line is added to it.
  Status use_rtu(const SerialLine& line, Duration response_timeout);

  Status open() noexcept override;
  void close() noexcept override;
  bool is_open() const noexcept override { return open_; }
  ModbusReply read(std::uint8_t unit_id, const ModbusBlock& block, std::uint16_t* words) noexcept override;
  ModbusReply write(std::uint8_t unit_id, const ModbusBlock& block, const std::uint16_t* words,
                    bool multiple) noexcept override;
  Duration longest_wait(const ModbusBlock& block, bool writes) const noexcept override;
  void resynchronise() noexcept override;
  Time now() const noexcept override { return MonotonicClock::now(); }

 private:
  Status use(_modbus* context, Duration response_timeout);
  void release() noexcept;
  Status cannot_open(int error) const noexcept;
  /// Before a request. A serial line is silent between two frames, for the time of 3.5 characters (Modbus
  /// over serial line V1.02, 2.5.1.1); and an answer that came after its time is not the next one's.
  void prepare(std::uint8_t unit_id, const ModbusBlock& block, bool writes) noexcept;
  /// The request and its answer, of which answer_ has the data.
  ModbusReply exchange(std::uint8_t unit_id, const ModbusPdu& request) noexcept;
  bool send(std::uint8_t unit_id, const ModbusPdu& request) noexcept;
  /// Whether the bytes received are an echo of the request.
  bool hears_itself(std::uint8_t unit_id, const ModbusPdu& request) const noexcept;
  ModbusReply own_echo() noexcept;
  ModbusReply judge(std::uint8_t unit_id, const ModbusPdu& request, std::size_t length) noexcept;
  ModbusReply exception(int error) noexcept;
  ModbusReply failure(int error) noexcept;
  template <class... Values>
  ModbusReply bad_reply(const char* format, Values... values) noexcept;

  _modbus* context_ = nullptr;
  bool serial_ = false;
  bool open_ = false;
  Duration response_timeout_{};
  Duration character_{};  // on a serial line
  Duration waits_{};      // for the answer to the request under way
  Duration silence_{};
  Time quiet_since_{};
  bool is_without_echo_ = false;           // since the serial line was opened: a request did not come back
  std::uint16_t transaction_ = 0;          // over TCP
  std::array<std::uint8_t, 260> frame_{};  // of the last answer, as much as came
  std::span<const std::uint8_t> answer_;   // in it
  std::array<char, 96> where_{};           // for messages
  std::array<char, 160> cause_{};          // of the last reply
};

}  // namespace flexrf
