// In the guest, whose /dev/ttyS1 and /dev/ttyS2 are two UARTs on one wire. The wire between them cannot be
// cut.
#include "hal/gripper/robotiq/tests/robotiq_world.hpp"

namespace {

using namespace flexrf;

class SerialLineWorld final : public RobotiqWorld {
 private:
  Status plug() override { return begin({"--serial", "/dev/ttyS1", "115200"}); }
  const char* device() const override { return "/dev/ttyS2"; }
};

}  // namespace

int main() {
  return run_gripper_conformance("Robotiq gripper on a serial line", []() -> std::unique_ptr<GripperWorld> {
    return std::make_unique<SerialLineWorld>();
  });
}
