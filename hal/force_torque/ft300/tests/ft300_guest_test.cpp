// In the guest, whose /dev/ttyS1 and /dev/ttyS2 are two UARTs on one wire. What is pulled out is the adapter:
// the wire between them cannot be cut.
#include "hal/force_torque/ft300/tests/ft300_world.hpp"
#include "tests/guest/serial_adapter.hpp"

namespace {

using namespace flexrf;

class SerialLineWorld final : public Ft300World {
 public:
  ~SerialLineWorld() override { driver().stop(); }
  /// The clock is counted: what the host does meanwhile is not seen in it.
  bool has_virtual_time() const override { return true; }

 private:
  Status plug() override { return begin({"--serial", "/dev/ttyS1"}); }
  const char* device() const override { return "/dev/ttyS2"; }
  bool unplug() override { return adapter_.unplug(); }
  bool plug_in() override { return adapter_.plug_in(); }

  SerialAdapter adapter_{"ttyS2"};
};

}  // namespace

int main() {
  return run_force_torque_conformance("FT300 on a serial line", []() -> std::unique_ptr<ForceTorqueWorld> {
    return std::make_unique<SerialLineWorld>();
  });
}
