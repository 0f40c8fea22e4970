#include "hal/robot_arm/melfa_mxt/simulator/mxt_wire.hpp"

#include <algorithm>

namespace flexrf::melfa {
namespace {

bool use_one(int& left) {
  if (left <= 0) return false;
  --left;
  return true;
}

}  // namespace

std::uint64_t MxtWire::cycles_until(Time now) {
  if (!paced_) {
    due_ = now;
    return 1;
  }
  if (began_ == Time{}) began_ = now;
  const auto length = duration_of(plan_.cycle).count();
  const auto cycle = static_cast<std::uint64_t>((now - began_).count() / length) + 1;
  const std::uint64_t cycles = cycle - cycle_;
  cycle_ = cycle;
  due_ = began_ + Duration{length * static_cast<std::int64_t>(cycle)};
  return cycles;
}

void MxtWire::arrived(std::span<const std::uint8_t> datagram, Time now) {
  if (silent_ || use_one(lost_packets_)) return;
  const auto answer = controller_.answer(datagram, cycles_until(now));
  if (!answer || use_one(lost_answers_)) return;
  if (use_one(delayed_answers_)) {
    held_back_ = answer;
    return;
  }
  if (held_back_) put(*held_back_, false);
  held_back_.reset();
  put(*answer, false);
}

void MxtWire::pop() {
  std::move(queue_.begin() + 1, queue_.begin() + static_cast<std::ptrdiff_t>(count_), queue_.begin());
  --count_;
}

void MxtWire::add_foreign(Foreign kind) {
  Packet packet;
  packet.reply_contents[0] = contents::joints;  // all joints at 0: it would be seen
  packet.counter = 0x8000'0000;
  PacketBytes bytes = pack(packet);
  switch (kind) {
    case Foreign::by_stranger:
      return put(bytes, true);
    case Foreign::too_short:
      return put(std::span(bytes).first(packet_bytes / 2), false);
    case Foreign::too_long: {
      std::array<std::uint8_t, packet_bytes + 4> longer{};
      std::copy(bytes.begin(), bytes.end(), longer.begin());
      return put(longer, false);
    }
    case Foreign::other_number:
      return put(bytes, false);
    case Foreign::nonsense:
      bytes.fill(0xA5);
      return put(bytes, false);
  }
}

void MxtWire::put(std::span<const std::uint8_t> bytes, bool by_stranger) {
  if (silent_ || count_ == queue_.size()) return;
  MxtDatagram& datagram = queue_[count_++];
  datagram.due = due_;
  datagram.by_stranger = by_stranger;
  datagram.size = bytes.size();
  std::copy(bytes.begin(), bytes.end(), datagram.bytes.begin());
}

}  // namespace flexrf::melfa
