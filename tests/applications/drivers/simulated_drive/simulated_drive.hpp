#pragma once

#include "simulated_drive_driver.hpp"

namespace flexrf::user {

class SimulatedDrive final : public SimulatedDriveDriver {
 public:
  ~SimulatedDrive() override { stop(); }
  Status initialise() override;
  void stop() override;
  double speed() const noexcept override { return speed_; }

 private:
  void follow(double speed) noexcept override { commanded_ = speed; }
  void forget() noexcept override { commanded_ = 0; }
  void act(const Tick& tick) noexcept override;
  void rest(const Tick& tick) noexcept override;
  bool become_safe() noexcept override;
  void approach() noexcept;
  void write_down(const char* text) noexcept;

  double commanded_ = 0;
  double speed_ = 0;
  int log_ = -1;
  int last_gasp_ = -1;
  bool moves_ = false;  // or did
  bool held_ = false;   // inhibited, as of the last cycle
  bool making_safe_ = false;
};

}  // namespace flexrf::user
