#include <optional>

#include "hal/socket/datagram/conformance/datagram_socket_conformance.hpp"
#include "hal/socket/datagram/mock/mock_datagram_socket.hpp"

namespace {

using namespace flexrf;

class MockWorld final : public DatagramSocketWorld {
 public:
  Status start(const DatagramWishes& wishes) override {
    bench_.emplace(nullptr);
    auto& configuration = bench_->configuration();
    if (wishes.has_remote) configuration.set_remote(text_of(FarEnd::peer));
    configuration.only_remote = wishes.only_remote;
    configuration.size = wishes.size;
    configuration.waiting = wishes.waiting;
    if (occupied_) far_ends().refuse(Status::error(StatusCode::busy, "scripted: it is in use"));
    return bench_->driver().initialise();
  }
  DatagramSocket& socket() override { return bench_->driver(); }
  const DatagramSocketFeedback& feedback() override { return bench_->feedback(); }
  void receive() override { bench_->receive(std::chrono::milliseconds(1)); }
  void send() override { bench_->send(); }
  std::optional<Time> now() const override { return bench_->now(); }
  void give(FarEnd end, std::string_view bytes) override { far_ends().give(text_of(end), bytes); }
  std::vector<std::string> got(FarEnd end) override { return far_ends().got(text_of(end)); }
  bool occupy() override { return occupied_ = true; }
  void leave() override {
    far_ends().break_off(Status::error(StatusCode::unavailable, "scripted: the peer is gone"));
  }
  void come_back() override { far_ends().break_off({}); }

 private:
  static const char* text_of(FarEnd end) { return end == FarEnd::peer ? "peer" : "stranger"; }
  MockDatagramTransport& far_ends() { return bench_->driver().far_ends(); }

  bool occupied_ = false;
  std::optional<DeviceBench<MockDatagramSocket>> bench_;
};

}  // namespace

int main() {
  return run_datagram_socket_conformance(
      "mock datagram socket",
      []() -> std::unique_ptr<DatagramSocketWorld> { return std::make_unique<MockWorld>(); });
}
