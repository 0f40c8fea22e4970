// A Modbus master that serves the stations of one link: what is due is asked, what changed is written, what
// fails is tried again after a growing pause, and no station keeps the others from their turn.
#pragma once

#include <array>
#include <atomic>
#include <memory>

#include "base/status.hpp"
#include "base/time.hpp"
#include "hal/modbus/link/interface/modbus_transport.hpp"

namespace flexrf {

struct ModbusExchange;
struct ModbusStationSetup;

class ModbusMaster {
 public:
  static constexpr std::size_t max_stations = 32;

  ModbusMaster() noexcept;
  ~ModbusMaster();

  /// Lifecycle thread; allocates. The exchange stays the link's. Error: another station that is attached has
  /// this unit id [modbus-master-9], or its registers cannot be asked for.
  Result<ModbusExchange*> attach(const ModbusStationSetup& setup);
  /// Lifecycle thread. The link may be in the middle of a request of this station, and ends it.
  static void detach(ModbusExchange& exchange) noexcept;

  struct Pauses {
    Duration shortest{};          ///< after a failure
    Duration longest{};           ///< after many
    Duration after_connecting{};  ///< nobody is asked in it [modbus-master-8]
  };
  /// Lifecycle thread. `name` is the link's, for messages; all outlive the last serve(). `longest_step`: of
  /// the link's thread; 0: nobody judges. Error, as of attach(): a station's request may take
  /// longer [modbus-master-1].
  Status start(const char* name, ModbusTransport& transport, Pauses pauses, Duration longest_step) noexcept;
  void stop() noexcept;

  /// The link's thread: everything that is due, one request after the other; of stations whose last request
  /// failed after that of the others [modbus-master-2]. A station that answers readings is read on while
  /// writing to it fails, one that answers writing is written to while its readings fail; safe values do not
  /// wait for the pause after other values have failed [modbus-master-5]. A single value is written by the
  /// functions that its station was found to know [modbus-master-6]. A register with refresh = no is written
  /// when its value changes, and after the station was not heard [modbus-master-7]. A register of the poll
  /// group `once` is read until the station has answered, and not again [modbus-master-10]. A request that
  /// fails ends the call, so that one call waits for at most one of them; the next begins behind that station
  /// [modbus-master-3]. The call also ends when the next request might take longer than what is left of the
  /// step of its thread; then the next call begins with that request [modbus-master-4].
  void serve() noexcept;
  /// Every station has its safe values, as of its last answer; but for those that know that themselves.
  bool is_safe() const noexcept;

  bool is_connected() const noexcept { return transport_ != nullptr && transport_->is_open(); }
  std::uint64_t connections() const noexcept { return connections_; }
  std::uint64_t requests() const noexcept { return requests_; }
  /// Empty before the first.
  const char* last_error() const noexcept { return last_error_.cause(); }

 private:
  Status check_waits(const ModbusExchange& exchange) const noexcept;
  bool open() noexcept;
  bool has_time_for(const ModbusBlock& block, bool writes) noexcept;
  bool serve_station(ModbusExchange& exchange) noexcept;
  bool write_what_is_due(ModbusExchange& exchange) noexcept;
  bool read_what_is_due(ModbusExchange& exchange) noexcept;
  /// False when the station, or the link, must be left alone for a while.
  bool judge(ModbusExchange& exchange, const ModbusBlock& block, bool writes, const ModbusReply& reply,
             Time asked) noexcept;
  void note_answer(ModbusExchange& exchange, bool writes) noexcept;
  void fail(ModbusExchange& exchange, const ModbusReply& reply, bool writes) noexcept;
  void note_lost() noexcept;
  Duration pause_after(std::uint32_t failures) const noexcept;

  std::array<std::atomic<ModbusExchange*>, max_stations> exchanges_{};
  std::array<std::unique_ptr<ModbusExchange>, max_stations> owned_;  // the lifecycle thread's

  const char* name_ = "";
  ModbusTransport* transport_ = nullptr;
  Duration shortest_{};
  Duration longest_{};
  Duration longest_turn_{};  // 0: as long as it takes
  std::size_t first_ = 0;    // whose turn is first
  Time turn_began_{};
  bool turn_is_new_ = false;  // nothing that waits was done in it
  bool out_of_time_ = false;
  Duration after_connecting_{};
  Time open_at_{};
  Time ready_at_{};  // for requests
  std::uint32_t open_failures_ = 0;
  std::uint64_t connections_ = 0;
  std::uint64_t requests_ = 0;
  Status last_error_;
};

}  // namespace flexrf
