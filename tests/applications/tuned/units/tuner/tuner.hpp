#pragma once

#include <cstdint>

#include "tuner_unit.hpp"

namespace flexrf::user {

class Tuner final : public TunerUnit {
 public:
  Status initialise() override;
  void step(const Tick& tick) override;

 private:
  void obey(char key, Time now);
  template <class T>
  void set_and_keep(std::uint16_t parameter, T value, Time now);

  bool learns_ = false;
};

}  // namespace flexrf::user
