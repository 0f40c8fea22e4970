// StreamSocketOn: a driver of StreamSocket over a generated base. What differs between drivers is what
// carries the bytes.
#pragma once

#include <algorithm>

#include "hal/socket/stream/interface/stream_links.hpp"

namespace flexrf {

template <class Base, class Transport>
class StreamSocketOn : public Base {
 public:
  Status initialise() override {
    const auto& set = this->configuration;
    stop();
    if (const Status status = transport_.open(set.address_view(), set.listen, duration_of(set.peer_timeout));
        !status) {
      return status;
    }
    links_.begin(this->name(), transport_,
                 {.listen = set.listen,
                  .sessions = set.sessions,
                  .buffer = set.buffer,
                  .connect_timeout = duration_of(set.connect_timeout),
                  .reconnect_shortest = duration_of(set.reconnect_shortest),
                  .reconnect_longest = duration_of(set.reconnect_longest)});
    this->feedback.port = transport_.port();
    return {};
  }
  void stop() override {
    links_.stop();
    transport_.shut();
  }

  void receive(const Tick& tick) noexcept override {
    links_.receive(tick.now);
    if (this->lines.is_connected()) push_lines();
  }
  void send(const Tick& tick) noexcept override { links_.send(tick.now); }

  std::span<const SocketSession> sessions() const noexcept override { return links_.sessions(); }
  bool write(SocketSession session, std::string_view bytes) noexcept override {
    return links_.write(session, bytes, false);
  }
  bool write_line(SocketSession session, std::string_view line) noexcept override {
    return links_.write(session, line, true);
  }
  std::optional<std::string_view> read_line(SocketSession session) noexcept override {
    return links_.read_line(session);
  }
  std::string_view peek(SocketSession session) const noexcept override { return links_.peek(session); }
  void take(SocketSession session, std::size_t count) noexcept override { links_.take(session, count); }
  void close(SocketSession session) noexcept override { links_.close(session); }

 protected:
  Transport& transport() noexcept { return transport_; }

 private:
  void push_lines() noexcept {
    for (const SocketSession session : links_.sessions()) {
      while (this->lines.has_room()) {
        const std::optional<std::string_view> text = links_.read_line(session);
        if (!text) break;
        SocketLine line;
        line.set_content(*text);
        const std::size_t size = std::min(text->size(), line.content.size());
        std::replace(line.content.begin(), line.content.begin() + static_cast<std::ptrdiff_t>(size), '\0',
                     '?');
        line.session = session;
        line.cut = size < text->size();
        this->lines.push(line);
      }
    }
  }

  Transport transport_;
  StreamLinks links_{this->feedback};
};

}  // namespace flexrf
