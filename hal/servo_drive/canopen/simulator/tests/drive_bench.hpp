// A node's master and a simulated drive, with a cable between them and a clock that moves as the test says.
#pragma once

#include "hal/canopen/drive_power.hpp"
#include "hal/canopen/node.hpp"
#include "hal/servo_drive/canopen/simulator/simulated_cia402_drive.hpp"

namespace flexrf {

using std::chrono::milliseconds;

inline constexpr std::uint8_t drive_node = 5;
inline constexpr std::uint8_t master_node = 127;
inline constexpr int cycle_ms = 7;

inline canopen::PdoPlan command_pdo() {
  canopen::PdoPlan plan{.direction = canopen::PdoDirection::received_by_node,
                        .identifier = canopen::receive_pdo_identifier(1, drive_node)};
  plan.add(canopen::cia402::objects::controlword, 16);
  plan.add(canopen::cia402::objects::target_position, 32);
  plan.add(canopen::cia402::objects::mode, 8);
  return plan;
}
inline canopen::PdoPlan velocity_pdo() {
  canopen::PdoPlan plan{.direction = canopen::PdoDirection::received_by_node,
                        .number = 2,
                        .identifier = canopen::receive_pdo_identifier(2, drive_node)};
  plan.add(canopen::cia402::objects::target_velocity, 32);
  return plan;
}
inline canopen::PdoPlan state_pdo() {
  canopen::PdoPlan plan{.direction = canopen::PdoDirection::sent_by_node,
                        .identifier = canopen::transmit_pdo_identifier(1, drive_node)};
  plan.add(canopen::cia402::objects::statusword, 16);
  plan.add(canopen::cia402::objects::actual_position, 32);
  plan.add(canopen::cia402::objects::mode_display, 8);
  return plan;
}

inline canopen::NodePlan node_plan() {
  canopen::NodePlan plan{.node = drive_node, .master = master_node};
  canopen::Configuration& list = plan.configuration;
  list.expect(canopen::objects::device_type, canopen::cia402::profile_number, 0xFFFF, "device profile");
  list.expect(canopen::objects::vendor, 0x123, 0xFFFFFFFF, "vendor");
  list.expect(canopen::objects::product, 0x456, 0xFFFFFFFF, "product");
  list.write(canopen::cia402::objects::abort_connection, 2, 3);
  list.write(canopen::cia402::objects::period_value, 1, cycle_ms);
  list.write(canopen::cia402::objects::period_exponent, 1, 0xFD);
  list.configure_pdo(command_pdo());
  list.configure_pdo(velocity_pdo());
  list.configure_pdo(state_pdo());
  return plan;
}

class DriveBench {
 public:
  Time now() const { return now_; }

  void begin(const canopen::NodePlan& plan = node_plan()) {
    began_ = node.begin(plan, now_, to_drive_);
    beat_.begin(milliseconds(50), now_);
  }
  const Status& began() const { return began_; }

  void run(int ms) {
    for (int i = 0; i < ms; ++i) step();
  }
  /// False: not within so many ms.
  bool run_until_operational(int ms) {
    for (int i = 0; i < ms && !node.is_operational(); ++i) step();
    return node.is_operational();
  }
  void send(const canopen::Message& message) {
    to_drive_.push(message);
    deliver();
  }

  SimulatedCia402Drive drive{{.node = drive_node}};
  canopen::Node node;
  bool cable = true;
  bool we_beat = true;
  canopen::Message last_state_pdo{};  ///< as the master heard it
  canopen::Outbox said_by_hand;       ///< of the drive, by faults on purpose

 private:
  void step() {
    now_ += milliseconds(1);
    node.advance(now_, to_drive_);
    if (beat_.is_due(now_) && we_beat) {
      to_drive_.push(canopen::heartbeat_message(canopen::NmtState::operational, master_node));
    }
    deliver();
    drive.advance(now_, to_master_);
    deliver();
  }
  void deliver() {
    while (!said_by_hand.is_empty()) {
      to_master_.push(said_by_hand.front());
      said_by_hand.pop();
    }
    while (!to_drive_.is_empty() || !to_master_.is_empty()) {
      while (!to_drive_.is_empty()) {
        const canopen::Message message = to_drive_.front();
        to_drive_.pop();
        if (cable) drive.receive(message, now_, to_master_);
      }
      while (!to_master_.is_empty()) {
        const canopen::Message message = to_master_.front();
        to_master_.pop();
        if (!cable) continue;
        if (message.identifier == state_pdo().identifier) last_state_pdo = message;
        node.receive(message, now_, to_drive_);
      }
    }
  }

  Time now_{std::chrono::seconds(1)};
  Status began_;
  canopen::Outbox to_drive_;
  canopen::Outbox to_master_;
  canopen::HeartbeatProducer beat_;
};

}  // namespace flexrf
