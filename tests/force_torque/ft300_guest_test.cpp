// In the guest, whose /dev/ttyS1 and /dev/ttyS2 are two UARTs on one wire. The wire between them cannot be
// cut.
#include "tests/force_torque/ft300_world.hpp"

namespace {

using namespace flexrf;

class SerialLineWorld final : public Ft300World {
 public:
  ~SerialLineWorld() override { driver().stop(); }

 private:
  Status plug() override {
    end_server();
    return serve(Ft300Server::on_serial_line("/dev/ttyS1", ft300::usual_unit_id));
  }
  const char* device() const override { return "/dev/ttyS2"; }
};

}  // namespace

int main() {
  return run_force_torque_conformance("FT300 on a serial line", []() -> std::unique_ptr<ForceTorqueWorld> {
    return std::make_unique<SerialLineWorld>();
  });
}
