// SocketCanBus: a CAN interface of this machine.
#pragma once

#include "hal/can/interface/can_bus.hpp"
#include "hal/can/socket_can/can_interface_claim.hpp"
#include "hal/can/socket_can/can_last_words.hpp"
#include "hal/can/socket_can/can_link_watch.hpp"
#include "hal/can/socket_can/can_socket.hpp"
#include "socket_can_bus_driver.hpp"

namespace flexrf {

/// Two system calls in a cycle, three when more than a batch has come. Bit rate, restart after bus-off and
/// the length of the transmit queue are the interface's, set with `ip link` (docs/devices/can.md).
/// Error of initialise(): another bus of this process has the interface.
class SocketCanBus final : public SocketCanBusDriver {
 public:
  ~SocketCanBus() override { stop(); }

  Status initialise() override;
  void stop() override;
  void receive(const Tick& tick) noexcept override;
  void send(const Tick& tick) noexcept override;
  int claim_last_word() override;
  void release_last_word(int place) override { last_words_.release(place); }
  void prepare_last_word(int place, const CanFrame& word, const CanFrame& all) noexcept override {
    last_words_.prepare(place, socket_, word, all);
  }
  int descriptor() const noexcept override { return socket_.descriptor(); }

 private:
  void listen_to(std::span<const CanIdentifier> identifiers) override;
  void follow_link() noexcept;
  void take(std::size_t count) noexcept;
  void note(const can_frame& error) noexcept;
  CanBusState usable_or_not() const noexcept;

  CanInterfaceClaim claim_;
  CanSocket socket_;
  CanLastWords last_words_;
  CanLinkWatch watch_;
  CanLinkWatch::View link_;
  CanBusState controller_ = CanBusState::error_active;  // as its error frames say
  std::uint64_t refused_in_look_ = 0;                   // the kernel refused a frame when this was the link
  std::uint32_t dropped_ = 0;
};

}  // namespace flexrf
