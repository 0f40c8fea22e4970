// SimulatedMelfa: a MELFA arm whose controller is a model in the same process, on the same clock.
#pragma once

#include "hal/robot_arm/melfa_mxt/mxt_arm.hpp"
#include "hal/robot_arm/melfa_mxt/simulator/mxt_wire.hpp"
#include "simulated_melfa_driver.hpp"

namespace flexrf {

/// The link to the model. A stranger's datagrams are dropped here, as a socket's driver would.
class MxtWireLink final : public DatagramLink {
 public:
  explicit MxtWireLink(melfa::MxtWire& wire) : wire_(&wire) {}

  bool send(std::span<const std::uint8_t> datagram, Time now) noexcept override {
    wire_->arrived(datagram, now);
    return true;
  }
  std::optional<ArrivedDatagram> receive(std::span<std::uint8_t> into, Time now) noexcept override;
  std::uint64_t strangers() const noexcept override { return strangers_; }

 private:
  melfa::MxtWire* wire_;
  std::uint64_t strangers_ = 0;
};

class SimulatedMelfa final : public melfa::MxtArm<SimulatedMelfaDriver> {
 public:
  Time next_event() const noexcept override;

  /// For tests: faults on purpose.
  melfa::MxtWire& far_end() noexcept { return wire_; }

 protected:
  Status open_link() override;
  void close_link() noexcept override {}
  DatagramLink& link() noexcept override { return link_; }
  const char* where() const noexcept override { return "the simulated controller"; }

 private:
  melfa::MxtWire wire_{{}, true};
  MxtWireLink link_{wire_};
};

}  // namespace flexrf
