// The driver and sockets of the test, over TCP on the loopback interface and within the machine. No port is
// fixed: the kernel chooses each.
#pragma once

#include <netinet/in.h>
#include <time.h>
#include <unistd.h>

#include <optional>

#include "hal/socket/stream/conformance/stream_socket_conformance.hpp"
#include "hal/socket/stream/linux/linux_stream_socket.hpp"

namespace flexrf {

class RealStreamWorld : public StreamSocketWorld {
 public:
  explicit RealStreamWorld(bool local) : local_(local) {
    if (local_) {
      static int count = 0;
      text_ = "unix:@flexrf-stream-" + std::to_string(getpid()) + "-" + std::to_string(count++);
    } else {
      // Bound and not listening: the port is nobody else's, and who connects is refused.
      text_ = "tcp:127.0.0.1:0";
      make_listener();
      text_ = "tcp:127.0.0.1:" + std::to_string(port_of(listener_));
    }
  }
  ~RealStreamWorld() override {
    for (const Far& far : far_) close_one(far.descriptor);
    close_one(listener_);
  }

  Status start(const StreamWishes& wishes, std::span<QueueSink* const> sinks) override {
    bench_.emplace(nullptr, sinks);
    bench_->configuration().set_address(
        wishes.listen && !local_ && !occupied_ ? std::string("tcp:127.0.0.1:0") : text_);
    bench_->configuration().listen = wishes.listen;
    bench_->configuration().sessions = wishes.sessions;
    bench_->configuration().buffer = wishes.buffer;
    bench_->configuration().connect_timeout = 30.0;
    bench_->configuration().peer_timeout = seconds(wishes.peer_timeout);
    return bench_->driver().initialise();
  }
  StreamSocket& socket() override { return bench_->driver(); }
  const StreamSocketFeedback& feedback() override { return bench_->feedback(); }
  void receive() override {
    const timespec pause{0, 500'000};
    nanosleep(&pause, nullptr);
    bench_->receive(MonotonicClock::now() - bench_->now());
    take_who_connected();
  }
  void send() override { bench_->send(); }

  bool occupy() override {
    occupied_ = true;
    if (local_) make_listener();
    ::listen(listener_, 8);
    return true;
  }
  void listen(bool /*on*/) override {
    if (listener_ < 0) make_listener();
    ::listen(listener_, 8);
    listens_ = true;
  }
  void connect() override {
    std::string text = text_;
    if (!local_) text = "tcp:127.0.0.1:" + std::to_string(bench_->feedback().port);
    const Result<std::vector<SocketAddress>> found = resolve(text, SOCK_STREAM, false);
    const int descriptor = ::socket(found->front().family(), SOCK_STREAM | SOCK_CLOEXEC, 0);
    static_cast<void>(::connect(descriptor, found->front().get(), found->front().size));
    far_.push_back({descriptor, {}, false});
  }
  std::size_t connections() override { return far_.size(); }
  bool give(std::size_t number, std::string_view bytes) override {
    return ::send(far_[number].descriptor, bytes.data(), bytes.size(), MSG_NOSIGNAL) ==
           static_cast<ssize_t>(bytes.size());
  }
  std::string got(std::size_t number) override {
    Far& far = far_[number];
    char bytes[4096];
    for (;;) {
      const ssize_t count = ::recv(far.descriptor, bytes, sizeof bytes, MSG_DONTWAIT);
      if (count == 0 || (count < 0 && errno == ECONNRESET)) far.ended = true;
      if (count <= 0) return far.got;
      far.got.append(bytes, static_cast<std::size_t>(count));
    }
  }
  bool is_ended(std::size_t number) override {
    static_cast<void>(got(number));
    return far_[number].ended;
  }
  void end(std::size_t number) override {
    close_one(far_[number].descriptor);
    far_[number].descriptor = -1;
  }
  /// Within the machine a connection is reset when it is closed with bytes unread in it.
  void break_off(std::size_t number) override {
    const linger at_once{1, 0};
    setsockopt(far_[number].descriptor, SOL_SOCKET, SO_LINGER, &at_once, sizeof at_once);
    if (local_) {
      bench_->driver().write_line(bench_->driver().sessions()[0], "unread");
      bench_->send();
    }
    end(number);
  }

 protected:
  bool is_local() const { return local_; }
  Time bench_time() const { return bench_->now(); }

 private:
  struct Far {
    int descriptor;
    std::string got;
    bool ended;
  };

  static void close_one(int descriptor) {
    if (descriptor >= 0) ::close(descriptor);
  }
  void make_listener() {
    const Result<std::vector<SocketAddress>> own = resolve(text_, SOCK_STREAM, true);
    listener_ = ::socket(own->front().family(), SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
    static_cast<void>(bind_to(listener_, own->front(), text_));
  }
  void take_who_connected() {
    if (!listens_) return;
    const int descriptor = ::accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC);
    if (descriptor >= 0) far_.push_back({descriptor, {}, false});
  }

  bool local_;
  bool occupied_ = false;
  bool listens_ = false;
  int listener_ = -1;
  std::string text_;
  std::vector<Far> far_;
  std::optional<DeviceBench<LinuxStreamSocket>> bench_;
};

}  // namespace flexrf
