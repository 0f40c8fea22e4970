// Requests through libmodbus, over TCP or a serial line.
#pragma once

#include <array>
#include <cstdint>

#include "hal/modbus/link/interface/modbus_transport.hpp"

struct _modbus;

namespace flexrf {

/// Settings: lifecycle thread. All else: the link's thread. Waits for answers, for at most longest_wait()
/// each; libmodbus' own recovery, which sleeps, stays off.
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
  ModbusReply write(std::uint8_t unit_id, const ModbusBlock& block,
                    const std::uint16_t* words) noexcept override;
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
  ModbusReply outcome(int result) noexcept;

  _modbus* context_ = nullptr;
  bool serial_ = false;
  bool open_ = false;
  Duration response_timeout_{};
  Duration character_{};  // on a serial line
  Duration waits_{};      // for the answer to the request under way
  Duration silence_{};
  Time quiet_since_{};
  std::array<char, 96> where_{};   // for messages
  std::array<char, 160> cause_{};  // of the last reply
};

}  // namespace flexrf
