#include <optional>

#include "hal/socket/stream/conformance/stream_socket_conformance.hpp"
#include "hal/socket/stream/mock/mock_stream_socket.hpp"

namespace {

using namespace flexrf;

class MockWorld final : public StreamSocketWorld {
 public:
  Status start(const StreamWishes& wishes, std::span<QueueSink* const> sinks) override {
    bench_.emplace(nullptr, sinks);
    bench_->configuration().listen = wishes.listen;
    bench_->configuration().sessions = wishes.sessions;
    bench_->configuration().buffer = wishes.buffer;
    far_ends().set_listening(listens_);
    if (occupied_) far_ends().refuse(Status::error(StatusCode::busy, "scripted: it is in use"));
    return bench_->driver().initialise();
  }
  StreamSocket& socket() override { return bench_->driver(); }
  const StreamSocketFeedback& feedback() override { return bench_->feedback(); }
  void receive() override {
    for (std::size_t i = 0; i < far_ends().connections(); ++i) far_ends().set_reads(i, false);
    for (const std::size_t number : asked_for_) far_ends().set_reads(number, true);
    bench_->receive(std::chrono::milliseconds(1));
  }
  void send() override { bench_->send(); }
  std::optional<Time> now() const override { return bench_->now(); }

  bool occupy() override { return occupied_ = true; }
  void listen(bool on) override {
    listens_ = on;
    if (bench_) far_ends().set_listening(on);
  }
  void connect() override { far_ends().connect_to_it(); }
  std::size_t connections() override { return far_ends().connections(); }
  bool give(std::size_t number, std::string_view bytes) override { return far_ends().give(number, bytes); }
  std::string got(std::size_t number) override {
    asked_for_.push_back(number);
    return std::string(far_ends().got(number));
  }
  bool is_ended(std::size_t number) override { return !far_ends().is_open(number); }
  void end(std::size_t number) override { far_ends().end(number); }
  void break_off(std::size_t number) override {
    far_ends().break_off(number, Status::error(StatusCode::unavailable, "scripted: it broke"));
  }
  bool unplug() override {
    listen(false);
    break_off(0);
    return true;
  }
  void plug_in() override { listen(true); }

 private:
  MockStreamTransport& far_ends() { return bench_->driver().far_ends(); }

  bool listens_ = false;
  bool occupied_ = false;
  std::vector<std::size_t> asked_for_;
  std::optional<DeviceBench<MockStreamSocket>> bench_;
};

}  // namespace

int main() {
  return run_stream_socket_conformance("mock stream socket", []() -> std::unique_ptr<StreamSocketWorld> {
    return std::make_unique<MockWorld>();
  });
}
