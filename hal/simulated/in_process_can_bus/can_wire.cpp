#include "hal/simulated/in_process_can_bus/can_wire.hpp"

#include <algorithm>
#include <bit>

#include "hal/simulated/in_process_can_bus/can_bit_count.hpp"

namespace flexrf {
namespace {

/// A node that wants to act again at once, and again, would stop the clock.
constexpr Duration shortest_pause = std::chrono::microseconds(1);

// SplitMix64 (Steele, Lea, Flood 2014): from 0 to below 1.
double draw(std::uint64_t& state) noexcept {
  std::uint64_t bits = (state += 0x9E37'79B9'7F4A'7C15U);
  bits = (bits ^ (bits >> 30U)) * 0xBF58'476D'1CE4'E5B9U;
  bits = (bits ^ (bits >> 27U)) * 0x94D0'49BB'1331'11EBU;
  bits ^= bits >> 31U;
  return static_cast<double>(bits >> 11U) * 0x1.0p-53;
}

bool wants(const std::vector<CanIdentifier>& wanted, const CanFrame& frame) {
  return wanted.empty() || std::find(wanted.begin(), wanted.end(),
                                     CanIdentifier{frame.identifier, frame.extended}) != wanted.end();
}

}  // namespace

// ---- who is there

void CanWire::reset(const Settings& settings) {
  turn_.take();
  bit_time_ = Duration(1'000'000'000 / std::max<std::int64_t>(settings.bit_rate, 1));
  restart_after_ = settings.restart_after;
  corrupted_share_ = settings.corrupted_share;
  random_ = settings.seed;
  next_event_ = now_ = free_at_ = ends_ = Time{};
  sender_ = nullptr;
  for (Place& place : places_) place.station->reset();
  turn_.give_back();
}

CanStation* CanWire::attach(CanNode& node, std::span<const CanIdentifier> wanted) {
  detach(node);
  if (places_.size() == most_nodes) return nullptr;
  Place place{std::make_unique<CanStation>(), {wanted.begin(), wanted.end()}};
  CanStation* station = place.station.get();
  station->node_ = &node;
  turn_.take();
  places_.push_back(std::move(place));
  index_listeners();
  turn_.give_back();
  return station;
}

void CanWire::detach(const CanNode& node) {
  turn_.take();
  // What it was sending goes with it, and the wire is free.
  if (sender_ != nullptr && sender_->node_ == &node) sender_ = nullptr;
  std::erase_if(places_, [&](const Place& place) { return place.station->node_ == &node; });
  index_listeners();
  turn_.give_back();
}

void CanWire::index_listeners() {
  listeners_.fill(0);
  extended_listeners_ = 0;
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const std::uint32_t bit = 1U << i;
    if (places_[i].wanted.empty()) {
      for (std::uint32_t& listeners : listeners_) listeners |= bit;
      extended_listeners_ |= bit;
    }
    for (const CanIdentifier& identifier : places_[i].wanted) {
      if (!identifier.is_valid()) continue;
      if (identifier.extended) {
        extended_listeners_ |= bit;
      } else {
        listeners_[identifier.value] |= bit;
      }
    }
  }
}

// ---- what happens

bool CanWire::advance(Time until) noexcept {
  if (!turn_.try_take()) return false;
  if (now_ == Time{}) now_ = until;
  Event event = next();
  for (; event.at <= until; event = next()) {
    now_ = event.at;
    happen(event);
  }
  next_event_ = event.at;
  now_ = std::max(now_, until);
  turn_.give_back();
  return true;
}

CanWire::Event CanWire::next() const noexcept {
  Event event;
  const auto consider = [&](Time at, Event::Kind kind, CanStation* station) {
    at = std::max(at, now_);
    if (at < event.at) event = {at, kind, station};
  };
  if (sender_ != nullptr) consider(ends_, Event::Kind::frame_ends, sender_);
  const Time quiet_at = std::max(free_at_, now_);
  CanStation* winner = nullptr;
  Time soonest = Time::max();
  for (const Place& place : places_) {
    CanStation& station = *place.station;
    consider(station.node_event_, Event::Kind::node_acts, &station);
    if (station.off_) consider(station.restart_at_, Event::Kind::restart, &station);
    if (sender_ != nullptr || !station.takes_part() || station.waiting_.is_empty()) continue;
    const Time at = std::max(quiet_at, station.silent_until_);
    const bool wins =
        at < soonest || (at == soonest && station.waiting_.first_key() < winner->waiting_.first_key());
    if (!wins) continue;
    winner = &station;
    soonest = at;
  }
  // Last: a node that acts at this very moment still takes part in the arbitration.
  if (winner != nullptr) consider(soonest, Event::Kind::frame_begins, winner);
  return event;
}

Time CanWire::may_begin(const CanStation& station) const noexcept {
  return std::max({free_at_, now_, station.silent_until_});
}

void CanWire::happen(const Event& event) noexcept {
  switch (event.kind) {
    case Event::Kind::none:
      break;
    case Event::Kind::frame_ends:
      end_frame();
      break;
    case Event::Kind::frame_begins:
      begin_frame(*event.station);
      break;
    case Event::Kind::node_acts:
      let_act(*event.station);
      break;
    case Event::Kind::restart:
      event.station->off_ = false;
      event.station->restart_at_ = Time::max();
      event.station->transmit_errors_ = event.station->receive_errors_ = 0;
      break;
  }
}

void CanWire::let_act(CanStation& station) noexcept {
  station.node_->on_time(now_, station);
  station.node_event_ = std::max(station.node_->next_event(), now_ + shortest_pause);
}

void CanWire::begin_frame(CanStation& sender) noexcept {
  for (const Place& place : places_) {
    CanStation& other = *place.station;
    const bool contends = &other != &sender && other.takes_part() && !other.waiting_.is_empty();
    if (contends && may_begin(other) <= now_) ++other.arbitrations_lost_;
  }
  sender_ = &sender;
  frame_ = sender.waiting_[0];
  frame_key_ = sender.waiting_.first_key();
  ends_ = now_ + bit_count(frame_) * bit_time_;
}

bool CanWire::is_hit(CanStation& sender) noexcept {
  if (sender.corrupted_ > 0) {
    --sender.corrupted_;
    return true;
  }
  return corrupted_share_ > 0 && draw(random_) < corrupted_share_;
}

bool CanWire::is_heard(const CanStation& sender) const noexcept {
  return sender.connected_ && std::any_of(places_.begin(), places_.end(), [&](const Place& place) {
           return place.station.get() != &sender && place.station->takes_part();
         });
}

void CanWire::end_frame() noexcept {
  CanStation& sender = *sender_;
  sender_ = nullptr;
  const bool hit = is_hit(sender);
  const bool heard = is_heard(sender);
  const bool good = heard && !hit;
  free_at_ = ends_ + (intermission_bits + (good ? 0 : error_frame_bits)) * bit_time_;
  if (good) {
    sender.waiting_.drop_one_of(frame_key_);
    sender.count_success_as_sender();
    for (const Place& place : places_) {
      CanStation& station = *place.station;
      if (&station != &sender && station.takes_part()) station.count_success_as_receiver();
    }
  } else {
    end_badly(sender, !heard && !hit);
  }
  if (sender.state() == CanBusState::error_passive)
    sender.silent_until_ = free_at_ + suspend_bits * bit_time_;
  if (good) deliver(sender);
}

void CanWire::end_badly(CanStation& sender, bool unacknowledged) noexcept {
  sender.count_transmit_error(unacknowledged);
  if (sender.off_ && restart_after_ > Duration{})
    sender.restart_at_ = now_ + restart_after_ + recovery_bits * bit_time_;
  if (unacknowledged) return;
  for (const Place& place : places_) {
    CanStation& station = *place.station;
    if (&station != &sender && station.takes_part()) station.count_receive_error();
  }
}

void CanWire::deliver(const CanStation& sender) noexcept {
  frame_.time = ends_;
  std::uint32_t listeners = frame_.extended ? extended_listeners_ : listeners_[frame_.identifier];
  for (; listeners != 0; listeners &= listeners - 1) {
    const Place& place = places_[static_cast<std::size_t>(std::countr_zero(listeners))];
    CanStation& station = *place.station;
    if (&station == &sender || !station.takes_part()) continue;
    if (frame_.extended && !wants(place.wanted, frame_)) continue;
    station.node_->on_frame(frame_, station);
    station.node_event_ = station.node_->next_event();
  }
}

}  // namespace flexrf
