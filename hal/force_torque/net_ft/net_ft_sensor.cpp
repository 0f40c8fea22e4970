#include "hal/force_torque/net_ft/net_ft_sensor.hpp"

#include <arpa/inet.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>

namespace flexrf {
namespace {

/// A thread that comes late must not be held for ever by what it missed.
constexpr int most_per_cycle = 256;
constexpr std::size_t most_bytes = 1500;

}  // namespace

Status NetFtSensor::initialise() {
  NetFtSensor::stop();
  if (Status status = begin_measuring(); !status) return status;
  if (Status status = session_.begin(
          {configuration.counts_per_force, configuration.counts_per_torque, configuration.family});
      !status)
    return status;
  const std::string address(configuration.address_view());
  sensor_ = {};
  sensor_.sin_family = AF_INET;
  sensor_.sin_port = htons(configuration.port);
  if (inet_pton(AF_INET, address.c_str(), &sensor_.sin_addr) != 1 || configuration.port == 0) {
    return Status::error(StatusCode::invalid_argument,
                         "`%s`, port %u, is no address: write the sensor's numeric one, as 192.168.1.1",
                         address.c_str(), unsigned{configuration.port});
  }
  socket_ = ::socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (socket_ < 0 || !ArrivalClock::enable(socket_))
    return Status::error(StatusCode::internal, "no socket for the sensor: %s", std::strerror(errno));
  return {};
}

void NetFtSensor::stop() {
  if (socket_ < 0) return;
  send_request(rdt::encode(rdt::Request{rdt::Command::stop, 0}));
  close(socket_);
  socket_ = -1;
}

void NetFtSensor::listen(WrenchMeter& meter, Time now) noexcept {
  arrival_.compare();
  for (int taken = 0; taken < most_per_cycle && take_datagram(meter, now); ++taken) {
  }
  const auto request = session_.request(now);
  if (!request) return;
  const int error = send_request(*request);
  if (error == 0) return;
  meter.note_away(
      Status::error(error == EACCES || error == EPERM ? StatusCode::not_permitted : StatusCode::unavailable,
                    "the sensor cannot be asked at %s: %s; is the network up?", configuration.address.data(),
                    std::strerror(error)));
}

/// False: there is none.
bool NetFtSensor::take_datagram(WrenchMeter& meter, Time now) noexcept {
  std::array<std::uint8_t, most_bytes> bytes;
  alignas(cmsghdr) std::array<char, ArrivalClock::control_bytes> control;
  sockaddr_in from{};
  iovec part{bytes.data(), bytes.size()};
  msghdr header{};
  header.msg_name = &from;
  header.msg_namelen = sizeof(from);
  header.msg_iov = &part;
  header.msg_iovlen = 1;
  header.msg_control = control.data();
  header.msg_controllen = control.size();
  const ssize_t size = recvmsg(socket_, &header, MSG_DONTWAIT);
  if (size < 0) return false;
  if (!is_from_sensor(from)) {
    meter.note_foreign();
  } else if ((header.msg_flags & MSG_TRUNC) != 0) {
    meter.note_damaged();
  } else {
    session_.take(std::span(bytes).first(static_cast<std::size_t>(size)), arrival_.time_of(header, now),
                  meter);
  }
  return true;
}

bool NetFtSensor::is_from_sensor(const sockaddr_in& from) const noexcept {
  return from.sin_addr.s_addr == sensor_.sin_addr.s_addr && from.sin_port == sensor_.sin_port;
}

/// 0, or an error number. A socket whose buffer is full loses the request, as the network may.
int NetFtSensor::send_request(const rdt::RequestBytes& request) noexcept {
  const ssize_t sent = sendto(socket_, request.data(), request.size(), MSG_DONTWAIT | MSG_NOSIGNAL,
                              reinterpret_cast<const sockaddr*>(&sensor_), sizeof(sensor_));
  return sent >= 0 || errno == EAGAIN ? 0 : errno;
}

}  // namespace flexrf
