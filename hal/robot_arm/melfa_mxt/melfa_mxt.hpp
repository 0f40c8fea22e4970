// MelfaMxt: a Mitsubishi MELFA arm, whose controller is in real-time external control (MXT) over UDP.
#pragma once

#include <array>

#include "hal/robot_arm/melfa_mxt/mxt_arm.hpp"
#include "hal/robot_arm/paced/udp_link.hpp"
#include "melfa_mxt_driver.hpp"

namespace flexrf {

class MelfaMxt final : public melfa::MxtArm<MelfaMxtDriver> {
 public:
  int descriptor() const noexcept override { return link_.descriptor(); }

 protected:
  Status open_link() override;
  void close_link() noexcept override { link_.close(); }
  DatagramLink& link() noexcept override { return link_; }
  const char* where() const noexcept override { return where_.data(); }

 private:
  UdpLink link_;
  std::array<char, 64> where_{};
};

}  // namespace flexrf
