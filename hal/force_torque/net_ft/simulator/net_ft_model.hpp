// NetFtModel: what an ATI sensor does with requests and time, without a socket.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "hal/force_torque/interface/wrench_meter.hpp"
#include "hal/force_torque/net_ft/rdt.hpp"

namespace flexrf {

/// A datagram on its way to whoever asked last.
struct NetFtDatagram {
  std::array<std::uint8_t, 64> bytes{};
  std::size_t size = 0;
  bool foreign = false;  ///< as if from another peer

  std::span<const std::uint8_t> view() const noexcept { return std::span(bytes).first(size); }
};

/// One thread at a time.
class NetFtModel {
 public:
  enum class Behaviour : std::uint8_t {
    well,
    silent,
    damaged,    ///< sends what is no record
    truncated,  ///< its records end early
    foreign,    ///< what comes is from somebody else
  };
  static constexpr double counts_per_force = 1e6;   // per N
  static constexpr double counts_per_torque = 1e6;  // per N m
  /// Status of Ethernet Axia: the load is out of range; its supply is.
  static constexpr std::uint32_t saturated = 0xC000'0000U;
  static constexpr std::uint32_t supply_fault = 0x8000'0002U;

  /// `rate`: records in a second.
  explicit NetFtModel(double rate = 500) noexcept;

  /// As after power-on: nobody has asked.
  void switch_off_and_on() noexcept;
  void receive(std::span<const std::uint8_t> request, Time now) noexcept;
  /// What is to be sent by now: to be asked until there is nothing.
  std::optional<NetFtDatagram> send(Time now) noexcept;
  /// When there will be something to send; Time::max(): when it is asked.
  Time next() const noexcept { return streams_ ? due_ : Time::max(); }

  void set_load(const std::array<double, 3>& force, const std::array<double, 3>& torque) noexcept;
  void set_status(std::uint32_t status) noexcept { status_ = status; }
  void set_behaviour(Behaviour behaviour) noexcept { behaviour_ = behaviour; }
  /// So many of the next records get lost.
  void lose(std::uint32_t count) noexcept { to_lose_ = count; }

 private:
  NetFtDatagram make() const noexcept;

  Duration period_;
  bool streams_ = false;
  std::uint32_t left_ = 0;  // records to send; 0: without end
  Time due_{};
  std::uint32_t sequence_ = 0;
  std::uint32_t sample_ = 0;
  std::uint32_t status_ = 0;
  std::array<std::int32_t, 3> force_{};
  std::array<std::int32_t, 3> torque_{};
  std::uint32_t to_lose_ = 0;
  Behaviour behaviour_ = Behaviour::well;
};

}  // namespace flexrf
