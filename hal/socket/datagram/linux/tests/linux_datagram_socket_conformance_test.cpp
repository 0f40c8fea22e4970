#include "hal/socket/datagram/linux/tests/real_datagram_world.hpp"

int main() {
  using namespace flexrf;
  const int failed = run_datagram_socket_conformance(
      "datagram socket over UDP",
      []() -> std::unique_ptr<DatagramSocketWorld> { return std::make_unique<RealDatagramWorld>(false); });
  return failed + run_datagram_socket_conformance("datagram socket within the machine",
                                                  []() -> std::unique_ptr<DatagramSocketWorld> {
                                                    return std::make_unique<RealDatagramWorld>(true);
                                                  });
}
