// DatagramSocketOn: a driver of DatagramSocket over a generated base. What differs between drivers is what
// carries the datagrams.
#pragma once

#include "hal/socket/datagram/interface/datagram_exchange.hpp"

namespace flexrf {

template <class Base, class Transport>
class DatagramSocketOn : public Base {
 public:
  Status initialise() override {
    const auto& set = this->configuration;
    transport_.shut();
    DatagramSettings settings{
        .remote = {}, .only_remote = set.only_remote, .size = set.size, .waiting = set.waiting};
    if (const Status status = transport_.open(set.local_view(), set.remote_view(), settings.remote);
        !status) {
      transport_.shut();
      return status;
    }
    exchange_.begin(this->name(), transport_, settings);
    this->feedback.port = transport_.port();
    return {};
  }
  void stop() override { transport_.shut(); }

  void receive(const Tick& tick) noexcept override { exchange_.receive(tick.now); }
  void send(const Tick& /*tick*/) noexcept override { exchange_.send(); }
  int descriptor() const noexcept override { return transport_.descriptor(); }

  std::optional<Datagram> read() noexcept override { return exchange_.read(); }
  bool write(std::span<const std::byte> bytes) noexcept override {
    return exchange_.write_to(exchange_.remote(), bytes);
  }
  bool write_to(const DatagramPeer& peer, std::span<const std::byte> bytes) noexcept override {
    return exchange_.write_to(peer, bytes);
  }

 protected:
  Transport& transport() noexcept { return transport_; }

 private:
  Transport transport_;
  DatagramExchange exchange_{this->feedback};
};

}  // namespace flexrf
