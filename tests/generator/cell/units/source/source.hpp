#pragma once

#include "source_unit.hpp"

namespace flexrf::user {

class Source final : public SourceUnit {
 public:
  Status accept(const Runtime& proposed) override {
    if (proposed.gain < -1) return Status::error(StatusCode::out_of_range, "gain below -1 is never meant");
    return {};
  }
  void step(const Tick& tick) override;
};

}  // namespace flexrf::user
