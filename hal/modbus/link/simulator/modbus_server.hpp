// A Modbus station that answers over TCP or a serial line, and can be made to answer wrongly.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

#include "base/status.hpp"
#include "base/time.hpp"
#include "hal/driver/helper_thread.hpp"
#include "hal/modbus/link/interface/modbus_station_model.hpp"
#include "hal/modbus/link/interface/register_map.hpp"

struct _modbus;
struct _modbus_mapping_t;

namespace flexrf {

/// Has a thread of its own and every address of all four areas, 0 at first. For one client at a time; a new
/// one takes the place of the one before. Any thread.
class ModbusServer {
 public:
  enum class Behaviour : std::uint8_t {
    well,
    silent,
    slow,                ///< answers after slow_delay
    refuses,             ///< slave device failure (exception 4)
    off_behind_gateway,  ///< as a gateway answers for it: the target did not respond (exception 11)
    damaged,             ///< sends what is no answer
    truncated,           ///< the answer ends early
    other_unit,          ///< answers as the next unit
    only_single,         ///< writes by functions 5 and 6 alone: the others are unknown to it
    only_multiple,       ///< writes by functions 15 and 16 alone
    cut,                 ///< ends every connection at once; over TCP only
  };
  /// By its name above, for what is commanded by text.
  static std::optional<Behaviour> behaviour_named(std::string_view name) noexcept;

  ~ModbusServer();

  /// On the loopback address; `port` 0: a free one, which port() tells.
  static Result<std::unique_ptr<ModbusServer>> on_tcp(std::uint8_t unit_id, std::uint16_t port);
  /// A serial line, opened with 8 data bits and one stop bit; `parity`: N, E or O.
  static Result<std::unique_ptr<ModbusServer>> on_serial_line(std::uint8_t unit_id, const std::string& device,
                                                              int baud, char parity = 'E');
  /// A serial line that is open already and stays its owner's.
  static Result<std::unique_ptr<ModbusServer>> on_descriptor(std::uint8_t unit_id, int descriptor);

  std::uint16_t port() const noexcept { return port_; }
  void set_behaviour(Behaviour behaviour) noexcept { behaviour_.store(behaviour); }
  /// How long an answer takes when it is slow.
  static constexpr Duration slow_delay = std::chrono::milliseconds(600);
  /// Requests to this unit so far.
  int requests() const noexcept { return requests_.load(); }

  std::uint16_t word(ModbusArea area, std::uint16_t address);
  void put(ModbusArea area, std::uint16_t address, std::uint16_t value);
  /// Every register becomes 0.
  void clear();
  /// The station does something with its registers, from now on; `model` outlives the server.
  void set_model(ModbusStationModel* model);

 private:
  ModbusServer() = default;
  /// Takes the context over; `status` says what failed where there is none.
  static Result<std::unique_ptr<ModbusServer>> begin(std::unique_ptr<ModbusServer> server, _modbus* context);
  void run();
  void accept();
  void serve();
  void answer(std::uint8_t* request, int length);
  void end_connection() noexcept;
  void follow() noexcept;

  _modbus* context_ = nullptr;
  _modbus_mapping_t* registers_ = nullptr;
  ModbusStationModel* model_ = nullptr;
  std::mutex registers_mutex_;  // of both
  std::uint8_t unit_id_ = 1;
  std::uint16_t port_ = 0;
  bool serial_ = false;
  bool owns_line_ = false;
  int listener_ = -1;
  int client_ = -1;
  std::atomic<Behaviour> behaviour_{Behaviour::well};
  std::atomic<int> requests_{0};
  HelperThread thread_;
};

}  // namespace flexrf
