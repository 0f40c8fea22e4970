// NetFtSession: the conversation with an ATI sensor over RDT, without a socket.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "hal/force_torque/interface/wrench_meter.hpp"
#include "hal/force_torque/net_ft/rdt.hpp"
#include "types/ati_family.hpp"

namespace flexrf {

struct NetFtPlan {
  double counts_per_force = 1e6;   ///< per N
  double counts_per_torque = 1e6;  ///< per N m
  AtiFamily family = AtiFamily::axia;
};

/// The thread of the sensor; begin(): the lifecycle thread.
class NetFtSession {
 public:
  /// Error: the plan makes no sense.
  Status begin(const NetFtPlan& plan) noexcept;

  /// A datagram of the sensor: one record, or several.
  void take(std::span<const std::uint8_t> datagram, Time at, WrenchMeter& meter) noexcept;
  /// What is to be sent to the sensor now, if anything: asked for while nothing comes.
  std::optional<rdt::RequestBytes> request(Time now) noexcept;

 private:
  void take_record(const rdt::Record& record, Time at, WrenchMeter& meter) noexcept;

  NetFtPlan plan_;
  Time heard_{};
  Time asked_{};
  bool awaits_stream_ = true;  // the next record begins one, whatever its number
  int asked_in_vain_ = 0;      // since: requests that may begin a stream anew yet
  std::uint32_t sequence_ = 0;
};

}  // namespace flexrf
