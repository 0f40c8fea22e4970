#include "hal/can/socket_can/socket_can_bus.hpp"

#include <string>

#include "hal/can/socket_can/can_error_frame.hpp"
#include "runtime/log/log.hpp"
#include "runtime/realtime/last_gasp.hpp"

namespace flexrf {

Status SocketCanBus::initialise() {
  stop();
  restart();
  controller_ = CanBusState::error_active;
  refused_in_look_ = 0;
  dropped_ = 0;
  link_ = {};
  const std::string named(configuration.interface_view());
  const char* interface = named.c_str();
  if (Status status = claim_.take(named, name()); !status) return status;
  if (Status status = socket_.open(); !status) return status;
  if (Status status = socket_.listen_to(wanted()); !status) return status;
  if (Status status = watch_.start(interface, socket_); !status) return status;
  follow_link();
  // It may come later, as a USB adapter does: no reason not to begin.
  if (const Status advice = CanLinkWatch::advice(link_.link, interface); !advice)
    log_warning(name(), "{}", advice.cause());
  return {};
}

void SocketCanBus::stop() {
  watch_.stop();
  last_words_.clear();
  socket_.close();
  claim_.release();
}

int SocketCanBus::claim_last_word() {
  const int place = last_words_.claim();
  if (place < 0) {
    log_warning(
        name(),
        "there is no room for what a further device on this bus is told in a crash ({} in all): it has "
        "to notice by itself, as a drive does by our heartbeat",
        last_gasp::slots);
  }
  return place;
}

void SocketCanBus::listen_to(std::span<const CanIdentifier> identifiers) {
  if (socket_.descriptor() < 0) return;
  if (const Status status = socket_.listen_to(identifiers); !status) log_error(name(), "{}", status.cause());
}

void SocketCanBus::receive(const Tick& /*tick*/) noexcept {
  follow_link();
  if (usable_or_not() == CanBusState::gone || !begin_delivery()) return;
  const std::size_t count = socket_.receive();
  take(count);
  if (count == CanSocket::most_received) take(socket_.receive());
  end_delivery();
  enter(usable_or_not());
}

void SocketCanBus::send(const Tick& /*tick*/) noexcept {
  CanSendQueue& frames = waiting();
  // What was prepared for a crash of another thread is the last that is said.
  if (frames.is_empty() || last_gasp::has_begun()) return;
  const CanSocket::Sent sent = socket_.send(frames);
  feedback.frames_sent += sent.frames;
  frames.drop_first(sent.frames);
  if (sent.is_full) ++feedback.send_retries;
  if (!sent.is_gone) return;
  // Sooner than the watch could tell; until it has looked again.
  refused_in_look_ = link_.look;
  enter(usable_or_not());
}

void SocketCanBus::follow_link() noexcept {
  CanLinkWatch::View seen = watch_.view();
  // While it comes up it has no carrier either; only one that was up and lost it is off the bus.
  if (seen.link == CanLinkWatch::Link::no_carrier && link_.link <= CanLinkWatch::Link::down)
    seen.link = CanLinkWatch::Link::down;
  // The controller begins anew when its interface does; and what it said of itself meanwhile may be lost.
  if (seen.link != link_.link) {
    const bool off = seen.link == CanLinkWatch::Link::no_carrier;
    controller_ = off ? CanBusState::bus_off : CanBusState::error_active;
  }
  link_ = seen;
  enter(usable_or_not());
}

CanBusState SocketCanBus::usable_or_not() const noexcept {
  if (link_.link <= CanLinkWatch::Link::not_can) return CanBusState::gone;
  if (link_.link == CanLinkWatch::Link::down || refused_in_look_ == link_.look) return CanBusState::down;
  return controller_;
}

void SocketCanBus::take(std::size_t count) noexcept {
  for (std::size_t i = 0; i < count; ++i) {
    if (socket_.is_error(i)) {
      note(socket_.error_frame(i));
      continue;
    }
    // Who hears others is on the bus, whatever was said and lost before.
    if (controller_ == CanBusState::bus_off) controller_ = CanBusState::error_active;
    deliver(socket_.frame(i));
  }
  feedback.frames_missed += socket_.dropped() - dropped_;
  dropped_ = socket_.dropped();
}

void SocketCanBus::note(const can_frame& error) noexcept {
  const CanErrorReport report = read_error_frame(error);
  if (report.state) controller_ = *report.state;
  // Each as it comes: two in one batch are two.
  enter(usable_or_not());
  if (report.bus_error) ++feedback.bus_errors;
  if (report.arbitration_lost) ++feedback.arbitrations_lost;
  if (report.receive_overflow) ++feedback.frames_missed;
  if (report.has_counters) {
    feedback.transmit_error_counter = report.transmit_errors;
    feedback.receive_error_counter = report.receive_errors;
  }
}

}  // namespace flexrf
