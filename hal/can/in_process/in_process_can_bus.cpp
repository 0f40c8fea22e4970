#include "hal/can/in_process/in_process_can_bus.hpp"

namespace flexrf {

Status InProcessCanBus::initialise() {
  restart();
  wire_.reset({.bit_rate = configuration.bit_rate,
               .restart_after = duration_of(configuration.restart_after),
               .corrupted_share = configuration.corrupted_share,
               .seed = environment().seed});
  station_ = wire_.attach(end_);
  if (station_ == nullptr)
    return Status::error(StatusCode::internal, "%s has no place left for its own end", name());
  pretended_ = CanBusState::error_active;
  tell_state();
  return {};
}

void InProcessCanBus::stop() {
  wire_.detach(end_);
  station_ = nullptr;
}

void InProcessCanBus::receive(const Tick& tick) noexcept {
  advance(tick.now);
}

void InProcessCanBus::send(const Tick& tick) noexcept {
  // What was on the wire before these frames were said comes first.
  if (!advance(tick.now)) return;
  CanSendQueue& frames = waiting();
  std::size_t taken = 0;
  while (taken < frames.size() && station_->waiting() < configuration.controller_queue &&
         station_->send(frames[taken])) {
    ++taken;
  }
  if (taken < frames.size()) ++feedback.send_retries;
  feedback.frames_sent += taken;
  frames.drop_first(taken);
  if (taken > 0) advance(tick.now);
}

void InProcessCanBus::pretend(CanBusState state) noexcept {
  pretended_ = state;
  const bool there = state == CanBusState::error_active;
  if (!there) station_->give_up();
  station_->set_connected(there);
}

bool InProcessCanBus::advance(Time now) noexcept {
  if (!begin_delivery()) return false;
  const bool advanced = wire_.advance(now);
  end_delivery();
  tell_state();
  return advanced;
}

void InProcessCanBus::tell_state() noexcept {
  feedback.bus_errors = station_->failed();
  feedback.arbitrations_lost = station_->arbitrations_lost();
  feedback.transmit_error_counter = static_cast<std::uint16_t>(station_->transmit_errors());
  feedback.receive_error_counter = static_cast<std::uint16_t>(station_->receive_errors());
  enter(pretended_ == CanBusState::error_active ? station_->state() : pretended_);
}

void InProcessCanBus::End::on_frame(const CanFrame& frame, CanPort& /*port*/) noexcept {
  bus->deliver(frame);
}

}  // namespace flexrf
