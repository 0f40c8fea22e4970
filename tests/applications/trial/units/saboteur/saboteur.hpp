#pragma once

#include <optional>

#include "saboteur_unit.hpp"

namespace flexrf::user {

class Saboteur final : public SaboteurUnit {
 public:
  Status initialise() override;
  void step(const Tick& tick) override;
  bool is_idle() const noexcept override { return !never_idle_ && drive->speed() == 0; }

 private:
  void obey(char key);

  std::optional<Pose> target_;
  bool drives_ = false;
  bool silent_ = false;
  bool never_idle_ = false;
  bool refused_ = false;
};

}  // namespace flexrf::user
