// NetFtSensor: a force-torque sensor of ATI with a network port.
#pragma once

#include <netinet/in.h>

#include "hal/driver/arrival_clock.hpp"
#include "hal/force_torque/interface/measuring_driver.hpp"
#include "hal/force_torque/net_ft/net_ft_session.hpp"
#include "net_ft_sensor_driver.hpp"

namespace flexrf {

/// Asks for its stream while nothing comes, so that a sensor may be switched on, or its cable put in, at any
/// time.
class NetFtSensor final : public MeasuringDriver<NetFtSensorDriver> {
 public:
  ~NetFtSensor() override { NetFtSensor::stop(); }

  Status initialise() override;
  /// Ends the sensor's stream.
  void stop() override;
  int descriptor() const noexcept override { return socket_; }

 private:
  void listen(WrenchMeter& meter, Time now) noexcept override;
  bool take_datagram(WrenchMeter& meter, Time now) noexcept;
  bool is_from_sensor(const sockaddr_in& from) const noexcept;
  int send_request(const rdt::RequestBytes& request) noexcept;

  int socket_ = -1;
  sockaddr_in sensor_{};
  NetFtSession session_;
  ArrivalClock arrival_;
};

}  // namespace flexrf
