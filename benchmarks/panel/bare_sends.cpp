#include "benchmarks/panel/bare_sends.hpp"

#include <arpa/inet.h>
#include <netinet/tcp.h>
#include <pthread.h>
#include <sys/epoll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <ctime>

#include "benchmarks/harness.hpp"

namespace flexrf::bench {

bool BareSends::begin(const Settings& settings) {
  settings_ = settings;
  const int listener = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  bool connected = listen(listener, settings.clients) == 0;  // at an address of the kernel's choice
  for (int i = 0; i < settings.clients && connected; ++i) connected = connect(listener);
  close(listener);
  if (!connected) return false;
  ends_ = false;
  reader_ = std::thread{[this] { read(); }};
  sender_ = std::thread{[this] { send(); }};
  return true;
}

bool BareSends::connect(int listener) {
  sockaddr_in address{};
  socklen_t size = sizeof(address);
  if (getsockname(listener, reinterpret_cast<sockaddr*>(&address), &size) != 0) return false;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  const int client = clients_.emplace_back(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
  if (::connect(client, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) != 0) return false;
  const int server = servers_.emplace_back(accept4(listener, nullptr, nullptr, SOCK_CLOEXEC));
  const int on = 1;
  return setsockopt(server, IPPROTO_TCP, TCP_NODELAY, &on, sizeof(on)) == 0;
}

void BareSends::send() {
  settle_thread(settings_.sending_cpu, 0);
  const std::vector<char> bytes(settings_.size, 'v');
  const std::int64_t interval = settings_.interval.count();
  while (!ends_) {
    const std::int64_t due = (MonotonicClock::now().time_since_epoch().count() / interval + 1) * interval;
    const timespec instant{due / 1'000'000'000, due % 1'000'000'000};
    clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &instant, nullptr);
    for (const int socket : servers_) {
      ::send(socket, bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    }
  }
}

void BareSends::read() {
  settle_thread(settings_.reading_cpu, 0);
  const int epoll = epoll_create1(EPOLL_CLOEXEC);
  for (const int socket : clients_) {
    epoll_event event{};
    event.events = EPOLLIN;
    event.data.fd = socket;
    epoll_ctl(epoll, EPOLL_CTL_ADD, socket, &event);
  }
  std::vector<char> bytes(65536);
  epoll_event events[64];
  while (!ends_) {
    const int count = epoll_wait(epoll, events, 64, 10);
    for (int i = 0; i < count; ++i) recv(events[i].data.fd, bytes.data(), bytes.size(), MSG_DONTWAIT);
  }
  close(epoll);
}

Duration BareSends::cpu_time() const {
  clockid_t clock{};
  timespec time{};
  if (pthread_getcpuclockid(const_cast<std::thread&>(sender_).native_handle(), &clock) == 0) {
    clock_gettime(clock, &time);
  }
  return std::chrono::seconds{time.tv_sec} + std::chrono::nanoseconds{time.tv_nsec};
}

void BareSends::end() {
  ends_ = true;
  if (sender_.joinable()) sender_.join();
  if (reader_.joinable()) reader_.join();
  for (const int socket : clients_) close(socket);
  for (const int socket : servers_) close(socket);
  clients_.clear();
  servers_.clear();
}

}  // namespace flexrf::bench
