// The far end of a link to a simulated MELFA controller: when its answers come, and what goes wrong on the
// way.
#pragma once

#include "base/time.hpp"
#include "hal/robot_arm/melfa_mxt/simulator/mxt_controller.hpp"

namespace flexrf::melfa {

/// What comes along, before the next answer.
enum class Foreign : std::uint8_t { by_stranger, too_short, too_long, other_number, nonsense };

/// A datagram on its way to the PC.
struct MxtDatagram {
  Time due{};
  bool by_stranger = false;  ///< not from the controller
  std::size_t size = 0;
  std::array<std::uint8_t, packet_bytes + 4> bytes{};
};

/// One thread; allocates nothing.
class MxtWire {
 public:
  /// `paced`: it answers at the beginning of its next cycle, else at once, and each packet is a cycle.
  MxtWire(const ControllerPlan& plan, bool paced) : controller_(plan), plan_(plan), paced_(paced) {}

  MxtController& controller() { return controller_; }
  const MxtController& controller() const { return controller_; }

  /// From the PC.
  void arrived(std::span<const std::uint8_t> datagram, Time now);
  /// The next one to the PC, whenever it is due; null: none.
  const MxtDatagram* first() const { return count_ == 0 ? nullptr : &queue_[0]; }
  void pop();

  /// Its network cable is out: nothing arrives, and it says nothing.
  void set_silent(bool on) { silent_ = on; }
  /// So many packets do not reach it.
  void lose_packets(int count) { lost_packets_ = count; }
  /// So many of its answers do not come.
  void lose_answers(int count) { lost_answers_ = count; }
  /// So many of its answers come only with the one after them.
  void delay_answers(int count) { delayed_answers_ = count; }
  void add_foreign(Foreign kind);

 private:
  std::uint64_t cycles_until(Time now);
  void put(std::span<const std::uint8_t> bytes, bool by_stranger);

  MxtController controller_;
  ControllerPlan plan_;
  bool paced_;
  bool silent_ = false;
  int lost_packets_ = 0;
  int lost_answers_ = 0;
  int delayed_answers_ = 0;
  std::optional<PacketBytes> held_back_;
  Time began_{};
  std::uint64_t cycle_ = 0;
  Time due_{};
  std::array<MxtDatagram, 16> queue_{};
  std::size_t count_ = 0;
};

}  // namespace flexrf::melfa
