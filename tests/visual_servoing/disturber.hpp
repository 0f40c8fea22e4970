// Disturber: a person beside the table who leaves nothing as it is, at instants that a seed decides.
#pragma once

#include <cstdint>
#include <string>

#include "hal/scene/world/scene_random.hpp"
#include "tests/visual_servoing/servoing_cell.hpp"

namespace flexrf::visual_servoing {

/// Every one to six seconds the person changes the light, between all that the table permits; adds an
/// obstacle beside the part that is gone to, beside a bin's middle, or anywhere; takes added obstacles away;
/// pushes a part; covers the lens for a while; or lays the table again. Within `hands_off` of a hand that
/// goes down blindly the person changes nothing: nobody could avoid that.
class Disturber {
 public:
  Disturber(ServoingCell& cell, std::uint64_t seed) : cell_(cell) { random_.seed(seed); }
  /// Once in each cycle.
  void look();
  /// So often the table was laid again, and with it what the hand held was gone.
  std::uint64_t tables() const { return tables_; }
  /// The person's last deed, in words.
  const std::string& deed() const { return deed_; }
  bool verbose = false;

 private:
  static constexpr double hands_off = 0.20;  // m
  void begin();
  void change_light();
  void choose_place();
  bool is_too_near() const;
  void tell(const std::string& deed);

  ServoingCell& cell_;
  SceneRandom random_;
  std::string deed_;
  std::uint64_t tables_ = 0;
  double next_ = 2;                // s since the start
  const char* button_ = nullptr;   // to be pressed once its place is set
  double uncover_ = 0;             // s since the start; 0: the lens is free
  std::array<double, 2> place_{};  // m
};

}  // namespace flexrf::visual_servoing
