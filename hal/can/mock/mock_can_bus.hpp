// MockCanBus: gives the frames that a test says and records what is sent.
#pragma once

#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "hal/can/interface/can_bus.hpp"
#include "mock_can_bus_driver.hpp"

namespace flexrf {

/// Error active from the start. For nodes that answer and for bit times: hal/can/in_process. A
/// test calls it between cycles, from the thread the bus lives in; it allocates.
class MockCanBus final : public MockCanBusDriver {
 public:
  Status initialise() override {
    restart();
    enter(CanBusState::error_active);
    return {};
  }

  void receive(const Tick& tick) noexcept override {
    if (!begin_delivery()) return;
    for (CanFrame& frame : said_) {
      frame.time = tick.now;
      deliver(frame);
    }
    said_.clear();
    end_delivery();
  }

  void send(const Tick& tick) noexcept override {
    CanSendQueue& frames = waiting();
    std::size_t taken = 0;
    for (; taken < frames.size() && taken < room_; ++taken) {
      sent_.push_back(frames[taken]);
      sent_.back().time = tick.now;
    }
    if (taken < frames.size()) ++feedback.send_retries;
    feedback.frames_sent += taken;
    frames.drop_first(taken);
  }

  // ---- for tests

  /// Another node says this; it arrives with the next cycle.
  void say(const CanFrame& frame) { said_.push_back(frame); }
  /// Everything that was sent since this was asked last, in its order, with the time of its cycle.
  std::vector<CanFrame> take_sent() { return std::exchange(sent_, {}); }
  void pretend(CanBusState state) noexcept { enter(state); }
  /// How many frames the controller takes in a cycle.
  void set_room(std::size_t frames) noexcept { room_ = frames; }

 private:
  std::vector<CanFrame> said_;
  std::vector<CanFrame> sent_;
  std::size_t room_ = std::numeric_limits<std::size_t>::max();
};

}  // namespace flexrf
