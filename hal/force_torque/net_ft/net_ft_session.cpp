#include "hal/force_torque/net_ft/net_ft_session.hpp"

#include <cmath>

#include "hal/force_torque/net_ft/ati_status.hpp"

namespace flexrf {
namespace {

/// A request may be lost as any datagram.
constexpr Duration asking_interval = std::chrono::milliseconds(100);
/// A stream that was begun anew is noticed by a number so small, also when its first records were lost.
constexpr std::uint32_t early = 1000;

bool is_scale(double counts) noexcept {
  return std::isfinite(counts) && counts > 0;
}

}  // namespace

Status NetFtSession::begin(const NetFtPlan& plan) noexcept {
  if (!is_scale(plan.counts_per_force) || !is_scale(plan.counts_per_torque)) {
    return Status::error(
        StatusCode::invalid_argument,
        "configuration.counts_per_force and counts_per_torque are numbers above 0; the sensor's "
        "web page has them");
  }
  *this = NetFtSession{};
  plan_ = plan;
  return {};
}

void NetFtSession::take(std::span<const std::uint8_t> datagram, Time at, WrenchMeter& meter) noexcept {
  if (datagram.empty() || datagram.size() % rdt::record_bytes != 0) {
    meter.note_damaged();
    return;
  }
  for (; !datagram.empty(); datagram = datagram.subspan(rdt::record_bytes))
    take_record(rdt::decode(datagram.first<rdt::record_bytes>()), at, meter);
}

void NetFtSession::take_record(const rdt::Record& record, Time at, WrenchMeter& meter) noexcept {
  const std::uint32_t step = record.sequence - sequence_;
  const bool forward = step != 0 && step < 0x8000'0000U;
  std::uint64_t missed = 0;
  if (awaits_stream_) {
    asked_in_vain_ = asked_in_vain_ > 0 ? asked_in_vain_ - 1 : 0;
  } else if (forward) {
    missed = step - 1;
  } else if (asked_in_vain_ > 0 && record.sequence < early) {
    // The request that was taken for lost was only late.
    --asked_in_vain_;
  } else {
    meter.note_damaged();  // old: overtaken on its way, or sent twice
    return;
  }
  awaits_stream_ = false;
  sequence_ = record.sequence;
  heard_ = at;
  if (const Status status = check_status(record.status, plan_.family); !status) {
    meter.take_fault(status, at);
    return;
  }
  RawWrench raw;
  for (std::size_t i = 0; i < 3; ++i) {
    raw.force[i] = record.force[i] / plan_.counts_per_force;
    raw.torque[i] = record.torque[i] / plan_.counts_per_torque;
  }
  raw.saturated = is_saturated(record.status, plan_.family);
  meter.take(raw, at, missed);
}

std::optional<rdt::RequestBytes> NetFtSession::request(Time now) noexcept {
  if (heard_ != Time{} && now - heard_ < asking_interval) return std::nullopt;
  if (asked_ != Time{} && now - asked_ < asking_interval) return std::nullopt;
  asked_ = now;
  awaits_stream_ = true;
  if (asked_in_vain_ < 1000) ++asked_in_vain_;
  return rdt::encode(rdt::Request{rdt::Command::stream, 0});
}

}  // namespace flexrf
