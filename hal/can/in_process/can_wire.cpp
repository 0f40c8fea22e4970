#include "hal/can/in_process/can_wire.hpp"

#include <algorithm>

#include "hal/can/in_process/can_bit_count.hpp"

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
  next_event_ = now_ = nodes_act_at_ = free_at_ = ends_ = Time{};
  senders_ = 0;
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
  index_places();
  turn_.give_back();
  return station;
}

void CanWire::detach(const CanNode& node) {
  turn_.take();
  // What it was sending goes with it, and the wire is free.
  if (sender_ != nullptr && sender_->node_ == &node) sender_ = nullptr;
  std::erase_if(places_, [&](const Place& place) { return place.station->node_ == &node; });
  index_places();
  turn_.give_back();
}

void CanWire::index_places() {
  listeners_.fill(0);
  extended_listeners_ = 0;
  nodes_act_at_ = Time{};
  senders_ = 0;
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const std::uint32_t bit = 1U << i;
    stations_[i] = places_[i].station.get();
    places_[i].station->set_place(bit, senders_);
    if (!places_[i].station->waiting_.is_empty()) senders_ |= bit;
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

inline CanStation* CanWire::next_sender() noexcept {
  CanStation* first = nullptr;
  for (std::uint32_t left = senders_; left != 0; left &= left - 1) {
    CanStation& station = station_of(left);
    if (station.waiting_.is_empty()) {
      senders_ &= ~station.bit_;
    } else if (station.takes_part() && (first == nullptr || goes_before(station, *first))) {
      first = &station;
    }
  }
  return first;
}

inline bool CanWire::goes_before(const CanStation& one, const CanStation& other) const noexcept {
  const Time at = may_begin(one);
  const Time other_at = may_begin(other);
  return at < other_at || (at == other_at && one.waiting_.first_key() < other.waiting_.first_key());
}

inline void CanWire::begin_frame(CanStation& sender) noexcept {
  for (std::uint32_t left = senders_ & ~sender.bit_; left != 0; left &= left - 1) {
    CanStation& other = station_of(left);
    const bool contends = other.takes_part() && !other.waiting_.is_empty();
    if (contends && may_begin(other) <= now_) ++other.arbitrations_lost_;
  }
  sender_ = &sender;
  frame_ = sender.waiting_[0];
  frame_key_ = sender.waiting_.first_key();
  frame_.time = ends_ = now_ + bit_count(frame_) * bit_time_;
}

inline bool CanWire::is_hit(CanStation& sender) noexcept {
  if (sender.corrupted_ > 0) {
    --sender.corrupted_;
    return true;
  }
  return corrupted_share_ > 0 && draw(random_) < corrupted_share_;
}

// Whoever takes part does; nobody: it was not heard.
inline bool CanWire::acknowledge(const CanStation& sender) noexcept {
  if (!sender.connected_) return false;
  bool is_heard = false;
  for (CanStation* const station : stations()) {
    if (station == &sender || !station->takes_part()) continue;
    station->count_success_as_receiver();
    is_heard = true;
  }
  return is_heard;
}

void CanWire::end_badly(CanStation& sender, bool unacknowledged) noexcept {
  sender.count_transmit_error(unacknowledged);
  if (sender.off_ && restart_after_ > Duration{})
    sender.restart_at_ = now_ + restart_after_ + recovery_bits * bit_time_;
  nodes_act_at_ = std::min(nodes_act_at_, sender.restart_at_);
  if (unacknowledged) return;
  for (const Place& place : places_) {
    CanStation& station = *place.station;
    if (&station != &sender && station.takes_part()) station.count_receive_error();
  }
}

inline void CanWire::deliver(const CanStation& sender) noexcept {
  std::uint32_t listeners = frame_.extended ? extended_listeners_ : listeners_[frame_.identifier];
  for (; listeners != 0; listeners &= listeners - 1) {
    CanStation& station = station_of(listeners);
    if (&station == &sender || !station.takes_part()) continue;
    if (frame_.extended && !wants(place_of(listeners).wanted, frame_)) continue;
    station.node_->on_frame(frame_, station);
    station.node_event_ = station.node_->next_event();
    nodes_act_at_ = std::min(nodes_act_at_, station.node_event_);
  }
}

inline void CanWire::end_frame() noexcept {
  CanStation& sender = *sender_;
  sender_ = nullptr;
  const bool hit = is_hit(sender);
  const bool good = !hit && acknowledge(sender);
  free_at_ = ends_ + (intermission_bits + (good ? 0 : error_frame_bits)) * bit_time_;
  if (good) {
    sender.waiting_.drop_one_of(frame_key_);
    sender.count_success_as_sender();
  } else {
    end_badly(sender, !hit);
  }
  if (sender.state() == CanBusState::error_passive)
    sender.silent_until_ = free_at_ + suspend_bits * bit_time_;
  if (good) deliver(sender);
}

// Frames mostly follow each other while no node does anything by itself: nothing else is looked for then. At
// the moment at which a node acts one that ends was heard before, and one that begins does so after the node
// took part in the arbitration. Returns when the next one ends or begins.
Time CanWire::pass_frames(Time until) noexcept {
  for (;;) {
    if (sender_ != nullptr) {
      if (ends_ > until || ends_ > nodes_act_at_) return ends_;
      now_ = ends_;
      end_frame();
    }
    CanStation* const sender = next_sender();
    if (sender == nullptr) return Time::max();
    const Time at = may_begin(*sender);
    if (at > until || at >= nodes_act_at_) return at;
    now_ = at;
    begin_frame(*sender);
  }
}

CanWire::Act CanWire::next_act() const noexcept {
  Act act;
  for (CanStation* const station : stations()) {
    const auto consider = [&](Time at, Act::Kind kind) {
      at = std::max(at, now_);
      if (at < act.at) act = {at, kind, station};
    };
    consider(station->node_event_, Act::Kind::node);
    if (station->off_) consider(station->restart_at_, Act::Kind::restart);
  }
  return act;
}

void CanWire::happen(const Act& act) noexcept {
  CanStation& station = *act.station;
  if (act.kind == Act::Kind::restart) {
    station.off_ = false;
    station.restart_at_ = Time::max();
    station.transmit_errors_ = station.receive_errors_ = 0;
    return;
  }
  station.node_->on_time(now_, station);
  station.node_event_ = std::max(station.node_->next_event(), now_ + shortest_pause);
}

bool CanWire::advance(Time until) noexcept {
  if (!turn_.try_take()) return false;
  if (now_ == Time{}) now_ = until;
  for (;;) {
    const Time frame_at = pass_frames(until);
    const Act act = next_act();
    const bool is_later = act.at > nodes_act_at_;
    nodes_act_at_ = act.at;
    if (is_later && frame_at <= until) continue;
    next_event_ = std::min(act.at, frame_at);
    if (act.at > until) break;
    now_ = act.at;
    happen(act);
  }
  now_ = std::max(now_, until);
  turn_.give_back();
  return true;
}

}  // namespace flexrf
