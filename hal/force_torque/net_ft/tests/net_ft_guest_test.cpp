// In the guest, whose loopback network can be taken down.
#include "hal/force_torque/net_ft/tests/net_ft_world.hpp"
#include "tests/guest/loopback_cable.hpp"

namespace {

using namespace flexrf;

class GuestWorld final : public NetFtWorld {
 public:
  /// The clock is counted: what the host does meanwhile is not seen in it.
  bool has_virtual_time() const override { return true; }

 private:
  bool unplug() override { return cable_.unplug(); }
  bool plug_in() override { return cable_.plug_in(); }

  LoopbackCable cable_;
};

}  // namespace

int main() {
  return run_force_torque_conformance("Net F/T over UDP", []() -> std::unique_ptr<ForceTorqueWorld> {
    return std::make_unique<GuestWorld>();
  });
}
