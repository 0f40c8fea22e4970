// The real driver over UDP, whose far end's cable is its port: it is closed and opened again.
#include "hal/force_torque/net_ft/tests/net_ft_world.hpp"

// Its macros would not spare names of ours.
#include "tests/cmocka.hpp"

namespace flexrf {
namespace {

class PortWorld final : public NetFtWorld {
  bool unplug() override { return say("unplug"); }
  bool plug_in() override { return say("plug"); }
};

Status refusal(const char* address, std::uint16_t port) {
  DeviceBench<NetFtSensor> bench(nullptr);
  bench.configuration().set_address(address);
  bench.configuration().port = port;
  return bench.driver().initialise();
}

void what_is_no_address_is_refused(void**) {
  assert_int_equal(refusal("sensor.local", 49152).code(), StatusCode::invalid_argument);
  assert_int_equal(refusal("10.0.0.300", 49152).code(), StatusCode::invalid_argument);
  assert_int_equal(refusal("127.0.0.1", 0).code(), StatusCode::invalid_argument);
}

}  // namespace
}  // namespace flexrf

int main() {
  using namespace flexrf;
  const CMUnitTest tests[] = {cmocka_unit_test(what_is_no_address_is_refused)};
  return cmocka_run_group_tests(tests, nullptr, nullptr) +
         run_force_torque_conformance("Net F/T over UDP", []() -> std::unique_ptr<ForceTorqueWorld> {
           return std::make_unique<PortWorld>();
         });
}
