#pragma once

#include "tuner_unit.hpp"

namespace flexrf::user {

class Tuner final : public TunerUnit {
 public:
  Status initialise() override;
  void step(const Tick& tick) override;

 private:
  void obey(char key);

  bool learns_ = false;
};

}  // namespace flexrf::user
