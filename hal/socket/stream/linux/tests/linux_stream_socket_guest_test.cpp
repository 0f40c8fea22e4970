// In the guest, whose loopback network can be taken down, and whose clock is counted: what the host does
// meanwhile is not seen in it.
#include "hal/socket/stream/linux/tests/real_stream_world.hpp"
#include "tests/guest/loopback_cable.hpp"

namespace {

using namespace flexrf;

class GuestWorld final : public RealStreamWorld {
 public:
  using RealStreamWorld::RealStreamWorld;
  std::optional<Time> now() const override { return bench_time(); }
  bool unplug() override { return !is_local() && cable_.unplug(); }
  void plug_in() override { cable_.plug_in(); }

 private:
  LoopbackCable cable_;
};

}  // namespace

int main() {
  const int failed = run_stream_socket_conformance(
      "stream socket over TCP",
      []() -> std::unique_ptr<StreamSocketWorld> { return std::make_unique<GuestWorld>(false); });
  return failed + run_stream_socket_conformance("stream socket within the machine",
                                                []() -> std::unique_ptr<StreamSocketWorld> {
                                                  return std::make_unique<GuestWorld>(true);
                                                });
}
