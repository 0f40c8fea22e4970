#pragma once

#include <cstdint>

#include "judge_unit.hpp"

namespace flexrf::user {

class Judge final : public JudgeUnit {
 public:
  void step(const Tick& tick) override;

 private:
  std::uint64_t beats_ = 0;
};

}  // namespace flexrf::user
