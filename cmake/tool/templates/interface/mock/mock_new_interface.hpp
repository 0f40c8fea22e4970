// MockNewInterface: switches nothing, and says what would have been switched.
#pragma once

#include "mock_new_interface_driver.hpp"

namespace flexrf {

class MockNewInterface final : public MockNewInterfaceDriver {
 public:
  Status initialise() override;

  // ---- for tests

  bool is_on() const noexcept { return on_; }

 private:
  void take_in(const Tick& tick) noexcept override;
  void set(bool on) noexcept override { commanded_ = on; }
  void forget() noexcept override { commanded_ = false; }
  void act(const Tick& tick) noexcept override;
  void rest(const Tick& tick) noexcept override;
  bool become_safe() noexcept override;
  void switch_to(bool on) noexcept;

  bool commanded_ = false;
  bool on_ = false;
};

}  // namespace flexrf
