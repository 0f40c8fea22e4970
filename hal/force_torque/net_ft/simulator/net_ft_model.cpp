#include "hal/force_torque/net_ft/simulator/net_ft_model.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace flexrf {
namespace {

/// One that is asked late does not make up for all that it missed.
constexpr int most_behind = 16;

std::int32_t counts_of(double value, double counts) noexcept {
  constexpr double most = std::numeric_limits<std::int32_t>::max();
  return static_cast<std::int32_t>(std::lround(std::clamp(value * counts, -most, most)));
}

}  // namespace

NetFtModel::NetFtModel(double rate) noexcept : period_{duration_of(1.0 / rate)} {}

void NetFtModel::switch_off_and_on() noexcept {
  streams_ = false;
  sample_ = 0;
  status_ = 0;
}

void NetFtModel::receive(std::span<const std::uint8_t> request, Time now) noexcept {
  const auto asked = rdt::decode_request(request);
  if (!asked) return;
  streams_ = asked->command == rdt::Command::stream;
  left_ = asked->count;
  sequence_ = 0;
  due_ = now + period_;
}

std::optional<NetFtDatagram> NetFtModel::send(Time now) noexcept {
  if (now - due_ > most_behind * period_) due_ = now - most_behind * period_;
  while (streams_ && due_ <= now) {
    due_ += period_;
    ++sequence_;
    ++sample_;
    if (left_ > 0) streams_ = --left_ > 0;
    if (to_lose_ > 0) {
      --to_lose_;
    } else if (behaviour_ != Behaviour::silent) {
      return make();
    }
  }
  return std::nullopt;
}

NetFtDatagram NetFtModel::make() const noexcept {
  const rdt::RecordBytes record = rdt::encode(rdt::Record{sequence_, sample_, status_, force_, torque_});
  NetFtDatagram datagram;
  datagram.size = record.size();
  std::copy(record.begin(), record.end(), datagram.bytes.begin());
  switch (behaviour_) {
    case Behaviour::damaged:
      for (std::uint8_t& byte : datagram.bytes) byte = static_cast<std::uint8_t>(byte * 31 + sample_ + 7);
      datagram.size = datagram.bytes.size();
      break;
    case Behaviour::truncated:
      datagram.size = record.size() - 11;
      break;
    case Behaviour::foreign:
      datagram.foreign = true;
      break;
    case Behaviour::well:
    case Behaviour::silent:
      break;
  }
  return datagram;
}

void NetFtModel::set_load(const std::array<double, 3>& force, const std::array<double, 3>& torque) noexcept {
  for (std::size_t i = 0; i < 3; ++i) {
    force_[i] = counts_of(force[i], counts_per_force);
    torque_[i] = counts_of(torque[i], counts_per_torque);
  }
}

}  // namespace flexrf
