// In the guest, whose loopback network can be taken down, and whose clock is counted: what the host does
// meanwhile is not seen in it.
#include "hal/socket/datagram/linux/tests/real_datagram_world.hpp"
#include "tests/guest/loopback_cable.hpp"

namespace {

using namespace flexrf;

class GuestWorld : public RealDatagramWorld {
 public:
  using RealDatagramWorld::RealDatagramWorld;
  std::optional<Time> now() const override { return bench_time(); }
};

/// The peer stays, and its cable goes.
class CableWorld final : public GuestWorld {
 public:
  CableWorld() : GuestWorld(false) {}
  void leave() override { cable_.unplug(); }
  void come_back() override { cable_.plug_in(); }

 private:
  LoopbackCable cable_;
};

template <class World, auto... Arguments>
std::unique_ptr<DatagramSocketWorld> make() {
  return std::make_unique<World>(Arguments...);
}

}  // namespace

int main() {
  return run_datagram_socket_conformance("datagram socket over UDP", make<GuestWorld, false>) +
         run_datagram_socket_conformance("datagram socket over UDP, with a cable", make<CableWorld>) +
         run_datagram_socket_conformance("datagram socket within the machine", make<GuestWorld, true>);
}
