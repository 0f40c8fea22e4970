#include "hal/socket/stream/linux/tests/real_stream_world.hpp"

int main() {
  using namespace flexrf;
  const int failed = run_stream_socket_conformance(
      "stream socket over TCP",
      []() -> std::unique_ptr<StreamSocketWorld> { return std::make_unique<RealStreamWorld>(false); });
  return failed + run_stream_socket_conformance("stream socket within the machine",
                                                []() -> std::unique_ptr<StreamSocketWorld> {
                                                  return std::make_unique<RealStreamWorld>(true);
                                                });
}
