#include "benchmarks/panel/live_load.hpp"

#include <sys/epoll.h>
#include <unistd.h>

#include <cstdio>
#include <cstring>

#include "benchmarks/harness.hpp"

namespace flexrf::bench {
namespace {

/// As the page does.
constexpr Duration ping_interval = std::chrono::milliseconds{250};
constexpr std::size_t header_size = 32;

template <class Value>
Value value_at(std::string_view bytes, std::size_t place) {
  Value value{};
  std::memcpy(&value, bytes.data() + place, sizeof(value));
  return value;
}

}  // namespace

bool LiveLoad::begin(const Settings& settings) {
  settings_ = settings;
  ends_ = false;
  clients_.clear();
  epoll_ = epoll_create1(EPOLL_CLOEXEC);
  for (int i = 0; i < settings.clients; ++i) {
    Client& client = clients_.emplace_back();
    client.reads = !settings.one_never_reads || i + 1 < settings.clients;
    if (!client.link.connect(settings.port, settings.session, client.reads ? 0 : 4096)) {
      std::fprintf(stderr, "panel: client %d of %d was not let in\n", i + 1, settings.clients);
      return false;
    }
    const std::uint64_t id = client.link.send("subscribe", "\"slots\":" + settings.slots);
    if (client.reads && client.link.answer_to(id).empty()) return false;
  }
  for (std::size_t i = 0; i < clients_.size(); ++i) {
    if (!clients_[i].reads) continue;
    epoll_event event{};
    event.events = EPOLLIN;
    event.data.u64 = i;
    epoll_ctl(epoll_, EPOLL_CTL_ADD, clients_[i].link.socket(), &event);
  }
  thread_ = std::thread{[this] { run(); }};
  return true;
}

LiveFigures LiveLoad::take() {
  const std::lock_guard lock{mutex_};
  return std::exchange(figures_, {});
}

void LiveLoad::end() {
  if (!thread_.joinable()) return;
  ends_ = true;
  thread_.join();
  clients_.clear();
  close(epoll_);
}

void LiveLoad::run() {
  settle_thread(settings_.cpu, 0);
  Time next_ping = MonotonicClock::now();
  epoll_event events[64];
  while (!ends_) {
    const int count = epoll_wait(epoll_, events, 64, 10);
    const std::lock_guard lock{mutex_};
    for (int i = 0; i < count; ++i) read(clients_[events[i].data.u64]);
    if (MonotonicClock::now() < next_ping) continue;
    ping();
    next_ping += ping_interval;
  }
}

void LiveLoad::ping() {
  for (Client& client : clients_) {
    if (client.open) client.link.send("ping", "\"sent\":0");
  }
}

void LiveLoad::read(Client& client) {
  const bool open = client.link.receive([&](bool binary, std::string_view payload) {
    if (binary && payload.size() >= header_size) note(client, payload);
  });
  if (open) return;
  epoll_ctl(epoll_, EPOLL_CTL_DEL, client.link.socket(), nullptr);
  client.open = false;
  ++figures_.closed;
}

/// Layout: docs/panel-protocol.md.
void LiveLoad::note(Client& client, std::string_view frame) {
  const auto server_time = value_at<std::int64_t>(frame, 8);
  const auto items = value_at<std::uint32_t>(frame, 16);
  const auto left_out = value_at<std::uint32_t>(frame, 20);
  const auto number = value_at<std::uint64_t>(frame, 24);
  if (client.number != 0) {
    figures_.lost += left_out - client.left_out + (number - client.number - 1);
    std::size_t place = header_size;
    for (std::uint32_t i = 0; i < items && place + header_size <= frame.size(); ++i) {
      figures_.missed += value_at<std::uint32_t>(frame, place + 28);
      const auto size = value_at<std::uint32_t>(frame, place + 4);
      place += header_size + (size + 7) / 8 * 8;
    }
  }
  client.number = number;
  client.left_out = left_out;
  ++figures_.frames;
  figures_.items += items;
  if (items == 0 || settings_.interval.count() == 0) return;
  // All clients' values are due at whole multiples of the interval.
  const std::int64_t due = server_time - server_time % settings_.interval.count();
  const std::int64_t now = MonotonicClock::now().time_since_epoch().count();
  figures_.delivery_us.push_back(static_cast<double>(now - due) * 1e-3);
}

}  // namespace flexrf::bench
