// The real driver and a simulated controller, that meet at a UDP port of this machine only. The driver's
// clock is the test's, so that no judgement depends on how busy the machine is.
#pragma once

#include <poll.h>

#include <ctime>
#include <memory>
#include <string>

#include "hal/interfaces/device_bench.hpp"
#include "hal/linux/melfa_mxt/melfa_mxt.hpp"
#include "hal/simulated/mxt_simulator/mxt_server.hpp"
#include "six_axis.hpp"

namespace flexrf {

class MelfaWorld {
 public:
  static constexpr Duration cycle = std::chrono::milliseconds(7);

  MelfaWorld() {
    melfa::ControllerPlan plan;
    plan.joints = six_axis.joint_count;
    plan.cycle = seconds(cycle);
    for (std::size_t i = 0; i < six_axis.joint_count; ++i) {
      plan.start[i] = six_axis.joints[i].home;
      plan.fastest[i] = six_axis.joints[i].velocity;
    }
    auto server = melfa::MxtServer::open(plan, false, "127.0.0.1", 0);
    if (!server) return;
    server_ = std::move(*server);
    auto& set = bench_.configuration();
    set.set_address("127.0.0.1");
    set.port = server_->port();
    set.cycle = plan.cycle;
    initialised_ = bench_.driver().initialise().is_ok();
  }
  ~MelfaWorld() { bench_.driver().stop(); }
  MelfaWorld(const MelfaWorld&) = delete;
  MelfaWorld& operator=(const MelfaWorld&) = delete;

  bool initialised() const { return initialised_; }
  MelfaMxt& arm() { return bench_.driver(); }
  std::uint16_t port() const { return server_->port(); }
  const auto& feedback() { return bench_.feedback(); }
  template <class Act>
  auto with(Act act) {
    return server_->with(act);
  }

  /// What was sent before has arrived, and its answers are there.
  void receive(Duration elapsed = cycle) {
    await_far_end();
    const auto& counted = arm().counters();
    if (server_->sent() > answers_before_ + counted.answered + counted.late + counted.foreign) {
      // On its way through the kernel.
      pollfd answer{arm().descriptor(), POLLIN, 0};
      poll(&answer, 1, patience);
    }
    bench_.receive(elapsed);
  }
  /// What was sent has arrived at the far end.
  void await_far_end() {
    for (int i = 0; i < 10 * patience && server_->received() < sent_before_ + arm().counters().sent; ++i) {
      const timespec pause{0, 100'000};
      nanosleep(&pause, nullptr);
    }
  }
  void send() { bench_.send(); }

  /// Cycles without a command.
  void idle(int cycles) {
    for (int i = 0; i < cycles; ++i) {
      receive();
      send();
    }
  }
  void command(const JointAngles& to, int cycles) {
    JointPositions wanted{};
    wanted.position = to;
    for (int i = 0; i < cycles; ++i) {
      receive();
      arm().command(wanted);
      send();
    }
  }
  /// As a person restarts a unit with its arm.
  bool restart() {
    arm().stop();
    // It may say its end several times while nobody answers, and be gone before it is heard.
    await_far_end();
    sent_before_ += arm().counters().sent;
    answers_before_ = server_->sent();
    arm().clear_fault();
    return arm().initialise().is_ok();
  }
  bool begin_leading() {
    for (int i = 0; i < 100 && !arm().is_leading(); ++i) idle(1);
    return arm().is_leading();
  }
  std::string alarm() {
    return with([](melfa::MxtWire& wire) { return std::string{wire.controller().alarm()}; });
  }

 private:
  static constexpr int patience = 30'000;  // ms

  std::unique_ptr<melfa::MxtServer> server_;
  DeviceBench<MelfaMxt> bench_{&six_axis};
  bool initialised_ = false;
  std::uint64_t sent_before_ = 0;     // by drivers before the restart
  std::uint64_t answers_before_ = 0;  // to them
};

}  // namespace flexrf
