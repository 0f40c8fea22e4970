#pragma once

#include <cstdint>

#include "benchmarks/panel_load/recording.hpp"
#include "camera_unit.hpp"

namespace flexrf::user {

class Camera final : public CameraUnit {
 public:
  Status initialise() override;
  void step(const Tick& tick) override;

 private:
  Recording* recording_ = nullptr;
};

}  // namespace flexrf::user
