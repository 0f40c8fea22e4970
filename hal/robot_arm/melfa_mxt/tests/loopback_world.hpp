// The controller is a thread of the test, and answers at once. The driver's clock is the test's, so that no
// judgement depends on how busy the machine is.
#pragma once

#include <poll.h>

#include <ctime>
#include <memory>

#include "hal/robot_arm/melfa_mxt/simulator/mxt_console.hpp"
#include "hal/robot_arm/melfa_mxt/simulator/mxt_server.hpp"
#include "hal/robot_arm/melfa_mxt/tests/melfa_world.hpp"

namespace flexrf {

class LoopbackWorld final : public MelfaWorld {
 public:
  LoopbackWorld() {
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
    initialise_arm(plan.cycle);
  }
  ~LoopbackWorld() override { arm().stop(); }

  std::uint16_t port() const override { return server_->port(); }
  std::string ask(std::string_view line) override {
    return server_->with([line](melfa::MxtWire& wire) { return melfa::obey(wire, line); });
  }

  void receive() override {
    await_far_end();
    const auto& counted = arm().counters();
    if (server_->sent() > answers_before_ + counted.answered + counted.late + counted.foreign) {
      // On its way through the kernel.
      pollfd answer{arm().descriptor(), POLLIN, 0};
      poll(&answer, 1, patience);
    }
    bench().receive(cycle);
  }
  void await_far_end() override {
    for (int i = 0; i < 10 * patience && server_->received() < sent_before_ + arm().counters().sent; ++i) {
      const timespec pause{0, 100'000};
      nanosleep(&pause, nullptr);
    }
  }

 private:
  static constexpr Duration cycle = std::chrono::milliseconds(7);  // the suite's
  static constexpr int patience = 30'000;                          // ms

  void begin_to_count_anew() override {
    sent_before_ += arm().counters().sent;
    answers_before_ = server_->sent();
  }

  std::unique_ptr<melfa::MxtServer> server_;
  std::uint64_t sent_before_ = 0;     // by drivers before the restart
  std::uint64_t answers_before_ = 0;  // to them
};

}  // namespace flexrf
