// CanWire: the wire between simulated CAN controllers.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "hal/can/in_process/can_station.hpp"
#include "hal/can/interface/can_node.hpp"
#include "hal/can/interface/turn.hpp"

namespace flexrf {

/// Frames take their bit times (the longest that stuffing can make them), the one with the highest priority
/// goes first, errors are signalled, counted and repeated, controllers go off the bus and come back. All of
/// it happens in advance(), in the order of time, and depends on nothing else. Of two nodes that send the
/// same identifier at once, which a real bus does not stand, the one attached first goes first.
class CanWire {
 public:
  static constexpr std::size_t most_nodes = 32;

  struct Settings {
    std::uint32_t bit_rate = 1'000'000;  ///< 1/s
    Duration restart_after{};            ///< of a controller that is off the bus; 0: never
    double corrupted_share = 0;          ///< of all transmissions, 0 to 1
    std::uint64_t seed = 1;
  };

  // ---- the lifecycle thread

  /// Begins anew at no time in particular. Who is attached stays so.
  void reset(const Settings& settings);
  /// Which outlives its place here. `wanted`: the frames that the node is told of; none: all. The station is
  /// the node's until detach(); null: there are most_nodes already.
  CanStation* attach(CanNode& node, std::span<const CanIdentifier> wanted = {});
  /// Nothing when it is not attached.
  void detach(const CanNode& node);

  // ---- the bus's thread; allocates nothing

  /// All that happens up to and at `until`. False: a node is just coming or going, nothing happened.
  bool advance(Time until) noexcept;
  /// When something will happen, as of the last advance(); Time::max(): nothing by itself.
  Time next_event() const noexcept { return next_event_; }
  Duration bit_time() const noexcept { return bit_time_; }

 private:
  /// What does not follow from a frame.
  struct Act {
    enum class Kind : std::uint8_t { node, restart };
    Time at = Time::max();
    Kind kind = Kind::node;
    CanStation* station = nullptr;
  };

  Act next_act() const noexcept;
  void happen(const Act& act) noexcept;
  Time pass_frames(Time until) noexcept;
  CanStation* next_sender() noexcept;
  bool goes_before(const CanStation& one, const CanStation& other) const noexcept;
  Time may_begin(const CanStation& station) const noexcept {
    return std::max({free_at_, now_, station.silent_until_});
  }
  void begin_frame(CanStation& sender) noexcept;
  void end_frame() noexcept;
  void end_badly(CanStation& sender, bool unacknowledged) noexcept;
  void deliver(const CanStation& sender) noexcept;
  bool is_hit(CanStation& sender) noexcept;
  bool acknowledge(const CanStation& sender) noexcept;
  void index_places();

  struct Place {
    std::unique_ptr<CanStation> station;
    std::vector<CanIdentifier> wanted;
  };
  /// Of the lowest bit in such a set; not of an empty one.
  const Place& place_of(std::uint32_t bits) const noexcept {
    return places_[static_cast<std::size_t>(std::countr_zero(bits))];
  }
  CanStation& station_of(std::uint32_t bits) const noexcept {
    return *stations_[static_cast<std::size_t>(std::countr_zero(bits))];
  }
  std::span<CanStation* const> stations() const noexcept {
    return std::span(stations_).first(places_.size());
  }

  Turn turn_;
  std::vector<Place> places_;                       // in the order of attachment
  std::array<CanStation*, most_nodes> stations_{};  // theirs
  std::array<std::uint32_t, 0x800> listeners_{};    // bit n: places_[n] wants this 11-bit identifier
  std::uint32_t extended_listeners_ = 0;            // wants some 29-bit identifiers
  Duration bit_time_{1000};
  Duration restart_after_{};
  double corrupted_share_ = 0;
  std::uint64_t random_ = 1;

  Time next_event_{};
  Time now_{};
  Time nodes_act_at_{};        // no node acts or restarts before; perhaps not then either
  std::uint32_t senders_ = 0;  // bit n: frames may wait at places_[n]; elsewhere none do
  Time free_at_{};
  CanStation* sender_ = nullptr;  // while a frame is on the wire
  CanFrame frame_;
  std::uint32_t frame_key_ = 0;
  Time ends_{};
};

}  // namespace flexrf
