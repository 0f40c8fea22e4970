// The driver and sockets of the test, over UDP on the loopback interface and within the machine. No port is
// fixed: the kernel chooses each.
#pragma once

#include <netinet/in.h>
#include <time.h>
#include <unistd.h>

#include <optional>

#include "hal/socket/datagram/conformance/datagram_socket_conformance.hpp"
#include "hal/socket/datagram/linux/linux_datagram_socket.hpp"

namespace flexrf {

class RealDatagramWorld : public DatagramSocketWorld {
 public:
  explicit RealDatagramWorld(bool local) : local_(local) {
    for (Far& far : far_) far.open(fresh_name());
    own_ = fresh_name();
  }
  ~RealDatagramWorld() override {
    for (Far& far : far_) far.shut();
    if (occupier_ >= 0) ::close(occupier_);
  }

  Status start(const DatagramWishes& wishes) override {
    bench_.emplace(nullptr);
    auto& configuration = bench_->configuration();
    configuration.set_local(own_);
    if (wishes.has_remote) configuration.set_remote(far_[0].text);
    configuration.only_remote = wishes.only_remote;
    configuration.size = wishes.size;
    configuration.waiting = wishes.waiting;
    const Status status = bench_->driver().initialise();
    if (!local_) own_ = "udp:127.0.0.1:" + std::to_string(bench_->feedback().port);
    return status;
  }
  DatagramSocket& socket() override { return bench_->driver(); }
  const DatagramSocketFeedback& feedback() override { return bench_->feedback(); }
  void receive() override {
    const timespec pause{0, 500'000};
    nanosleep(&pause, nullptr);
    bench_->receive(MonotonicClock::now() - bench_->now());
  }
  void send() override { bench_->send(); }

  void give(FarEnd end, std::string_view bytes) override {
    const Result<std::vector<SocketAddress>> to = resolve(own_, SOCK_DGRAM, false);
    static_cast<void>(::sendto(far(end).descriptor, bytes.data(), bytes.size(), MSG_NOSIGNAL,
                               to->front().get(), to->front().size));
  }
  std::vector<std::string> got(FarEnd end) override {
    char bytes[256];
    for (;;) {
      const ssize_t count = ::recv(far(end).descriptor, bytes, sizeof bytes, MSG_DONTWAIT);
      if (count < 0) return far(end).got;
      far(end).got.emplace_back(bytes, static_cast<std::size_t>(count));
    }
  }
  bool occupy() override {
    const Result<std::vector<SocketAddress>> own = resolve(own_, SOCK_DGRAM, true);
    occupier_ = ::socket(own->front().family(), SOCK_DGRAM | SOCK_CLOEXEC, 0);
    if (!bind_to(occupier_, own->front(), own_)) return false;
    if (!local_) own_ = "udp:127.0.0.1:" + std::to_string(port_of(occupier_));
    return true;
  }
  void leave() override { far_[0].shut(); }
  void come_back() override { far_[0].open(far_[0].text); }

 protected:
  Time bench_time() const { return bench_->now(); }

 private:
  struct Far {
    int descriptor = -1;
    std::string text;
    std::vector<std::string> got;

    void open(const std::string& where) {
      const Result<std::vector<SocketAddress>> own = resolve(where, SOCK_DGRAM, true);
      descriptor = ::socket(own->front().family(), SOCK_DGRAM | SOCK_CLOEXEC, 0);
      static_cast<void>(bind_to(descriptor, own->front(), where));
      text = where;
      if (port_of(descriptor) != 0) text = "udp:127.0.0.1:" + std::to_string(port_of(descriptor));
    }
    void shut() {
      if (descriptor >= 0) ::close(descriptor);
      descriptor = -1;
    }
  };

  std::string fresh_name() const {
    static int count = 0;
    if (!local_) return "udp:127.0.0.1:0";
    return "unix:@flexrf-datagram-" + std::to_string(getpid()) + "-" + std::to_string(count++);
  }
  Far& far(FarEnd end) { return far_[static_cast<std::size_t>(end)]; }

  bool local_;
  int occupier_ = -1;
  std::string own_;
  Far far_[2];
  std::optional<DeviceBench<LinuxDatagramSocket>> bench_;
};

}  // namespace flexrf
