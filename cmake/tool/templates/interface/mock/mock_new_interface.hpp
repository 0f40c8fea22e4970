// MockNewInterface: switches nothing, and says what would have been switched.
#pragma once

#include "mock_new_interface_driver.hpp"

namespace flexrf {

class MockNewInterface final : public MockNewInterfaceDriver {
 public:
  Status initialise() override;
  void receive(const Tick& tick) noexcept override;
  void send(const Tick& tick) noexcept override;
  bool make_safe() noexcept override;
  void command(bool on) noexcept override;

  // ---- for tests

  bool is_on() const noexcept { return on_; }

 private:
  void switch_to(bool on) noexcept;

  bool commanded_ = false;
  bool on_ = false;
};

}  // namespace flexrf
