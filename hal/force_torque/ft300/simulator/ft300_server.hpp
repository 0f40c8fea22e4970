// Ft300Server: a simulated FT300 on a serial line.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "base/status.hpp"
#include "hal/driver/helper_thread.hpp"
#include "hal/force_torque/ft300/ft300_stream.hpp"
#include "hal/force_torque/ft300/serial_port.hpp"

namespace flexrf {

/// Knows the request that begins its stream and the bytes that end it, and no other of the sensor's
/// registers. Has a thread of its own. Any thread.
class Ft300Server {
 public:
  enum class Behaviour : std::uint8_t {
    well,
    silent,
    damaged,    ///< a bit is turned in each frame
    truncated,  ///< its frames end early
  };

  /// A line that is open already and stays its owner's.
  static Result<std::unique_ptr<Ft300Server>> on_descriptor(int descriptor, std::uint8_t unit_id);
  /// Opened with 19200 bit/s.
  static Result<std::unique_ptr<Ft300Server>> on_serial_line(const std::string& device, std::uint8_t unit_id);

  /// N and N m; what a frame does not hold is cut.
  void set_load(const std::array<double, 3>& force, const std::array<double, 3>& torque);
  void set_behaviour(Behaviour behaviour);
  /// As after power-on: nobody has asked.
  void switch_off_and_on();
  bool streams();

 private:
  Ft300Server() = default;
  static Result<std::unique_ptr<Ft300Server>> begin(std::unique_ptr<Ft300Server> server);
  void run();
  void receive();
  void heed(std::uint8_t byte);
  void send();

  SerialPort port_;  // of a line of its own
  int line_ = -1;
  std::uint8_t unit_id_ = ft300::usual_unit_id;
  std::vector<std::uint8_t> heard_;  // the newest bytes, as long as a request
  int ones_ = 0;

  std::mutex mutex_;  // of all below
  bool streams_ = false;
  ft300::Frame frame_;
  Behaviour behaviour_ = Behaviour::well;
  HelperThread thread_;  // ends first
};

}  // namespace flexrf
