#pragma once

#include "simulated_drive_driver.hpp"

namespace flexrf::user {

class SimulatedDrive final : public SimulatedDriveDriver {
 public:
  ~SimulatedDrive() override { stop(); }
  Status initialise() override;
  void stop() override;
  void command(double speed) noexcept override { commanded_ = speed; }
  double speed() const noexcept override { return speed_; }
  void send(const Tick& tick) noexcept override;
  bool make_safe() noexcept override;

 private:
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
