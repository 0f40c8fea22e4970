// Feeder: what the feeder of a pick station does, for a station that exists in memory only, here or in
// another process.
#pragma once

#include <cstdint>
#include <span>

#include "hal/modbus/link/interface/modbus_station_model.hpp"

namespace flexrf::user {

/// It moves on by one place whenever next_part rises; a moment later there is the next part, as long as there
/// are any. The registers are those of io_station.csv. It does not know whether the part was really taken.
class Feeder final : public ModbusStationModel {
 public:
  struct Settings {
    Duration travel = std::chrono::milliseconds(600);  ///< from one place to the next
    std::uint32_t stock = 0;                           ///< parts until it is empty; 0: it never is
  };
  static constexpr std::size_t part_present = 0;  // holding registers
  static constexpr std::size_t next_part = 1;

  explicit Feeder(const Settings& settings) noexcept : settings_(settings), stock_(settings.stock) {}

  void follow(Time now, std::span<std::uint16_t> holding) noexcept override {
    if (holding.size() <= next_part) return;
    const bool asked = holding[next_part] != 0;
    if (asked && !was_asked_) moves_since_ = now;
    was_asked_ = asked;
    const bool travels = moves_since_ != Time{} && now - moves_since_ < settings_.travel;
    if (moves_since_ != Time{} && !travels) {
      moves_since_ = Time{};
      ++brought_;
    }
    const bool has_more = settings_.stock == 0 || brought_ < stock_;
    holding[part_present] = !travels && has_more ? 1 : 0;
  }

  /// A person puts more in.
  void fill(std::uint32_t parts) noexcept { stock_ = brought_ + parts; }

 private:
  Settings settings_;
  std::uint32_t stock_;
  std::uint32_t brought_ = 0;  // places that it moved on by
  bool was_asked_ = false;
  Time moves_since_{};
};

}  // namespace flexrf::user
