#pragma once

#include <array>
#include <vector>

#include "eye_unit.hpp"
#include "units/vision/outline_fit.hpp"

namespace flexrf::user {

/// A part of the scene.
struct LaidPart {
  std::size_t kind;
  OutlinePose pose;
};
/// Two of them touch.
inline const std::array<LaidPart, 6> laid_parts{{{0, {{0.36, 0.07}, 0.3}},
                                                 {1, {{0.46, 0.09}, 0.0}},
                                                 {2, {{0.55, 0.06}, 0.2}},
                                                 {3, {{0.37, -0.07}, 1.2}},
                                                 {1, {{0.47, -0.06}, 0.0}},
                                                 {1, {{0.47, -0.0995}, 0.0}}}};

class Eye final : public EyeUnit {
 public:
  Status initialise() override;
  void step(const Tick& tick) override;

 private:
  std::array<std::vector<std::uint8_t>, 4> pictures_;
  std::uint64_t count_ = 0;
};

}  // namespace flexrf::user
