#include "benchmarks/panel/live_client.hpp"

#include <arpa/inet.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>

namespace flexrf::bench {

bool LiveClient::connect(int port, const std::string& session, int receive_buffer) {
  socket_ = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  if (receive_buffer > 0) setsockopt(socket_, SOL_SOCKET, SO_RCVBUF, &receive_buffer, sizeof(receive_buffer));
  const int on = 1;
  setsockopt(socket_, IPPROTO_TCP, TCP_NODELAY, &on, sizeof(on));
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  if (::connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) != 0) return false;
  const std::string host = "127.0.0.1:" + std::to_string(port);
  const std::string request = "GET /api/v1/live HTTP/1.1\r\nHost: " + host + "\r\nOrigin: http://" + host +
                              "\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
                              "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n"
                              "Sec-WebSocket-Protocol: flexrf.v1\r\n" +
                              session + "\r\n";
  ::send(socket_, request.data(), request.size(), MSG_NOSIGNAL);
  for (std::size_t end = std::string::npos; end == std::string::npos;) {
    pollfd readable{socket_, POLLIN, 0};
    if (poll(&readable, 1, 5000) != 1 || !read_some()) return false;
    end = input_.find("\r\n\r\n");
    if (end == std::string::npos) continue;
    const bool upgraded = input_.starts_with("HTTP/1.1 101");
    input_.erase(0, end + 4);
    return upgraded;
  }
  return false;
}

void LiveClient::close() noexcept {
  if (socket_ >= 0) ::close(std::exchange(socket_, -1));
}

std::uint64_t LiveClient::send(std::string_view op, std::string_view fields) {
  std::string text = "{\"op\":\"";
  text.append(op).append("\",\"id\":").append(std::to_string(++id_));
  if (!fields.empty()) text.append(",").append(fields);
  text.append("}");
  // One frame, masked with zeros: a mask must be there, and this one changes nothing.
  std::string frame = "\x81";
  if (text.size() < 126) {
    frame.push_back(static_cast<char>(0x80 | text.size()));
  } else {
    frame.push_back(static_cast<char>(0x80 | 126));
    frame.push_back(static_cast<char>(text.size() >> 8));
    frame.push_back(static_cast<char>(text.size()));
  }
  frame.append(4, '\0').append(text);
  ::send(socket_, frame.data(), frame.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
  return id_;
}

bool LiveClient::read_some() {
  char part[65536];
  for (;;) {
    const ssize_t size = recv(socket_, part, sizeof(part), MSG_DONTWAIT);
    if (size < 0) return errno == EAGAIN || errno == EINTR;
    if (size == 0) return false;
    input_.append(part, static_cast<std::size_t>(size));
    if (static_cast<std::size_t>(size) < sizeof(part)) return true;
  }
}

bool LiveClient::next_message(std::size_t& taken, bool& binary, std::string_view& payload) const {
  const auto byte = [&](std::size_t place) { return static_cast<unsigned char>(input_[taken + place]); };
  const std::size_t there = input_.size() - taken;
  if (there < 2) return false;
  std::size_t head = 2;
  std::size_t size = byte(1) & 127U;
  const std::size_t size_bytes = size == 126 ? 2 : size == 127 ? 8 : 0;
  if (there < head + size_bytes) return false;
  if (size_bytes > 0) {
    size = 0;
    for (std::size_t i = 0; i < size_bytes; ++i) size = size << 8 | byte(head + i);
    head += size_bytes;
  }
  if (there < head + size) return false;
  binary = (byte(0) & 15U) == 2;
  payload = std::string_view{input_}.substr(taken + head, size);
  taken += head + size;
  return true;
}

std::string LiveClient::answer_to(std::uint64_t id) {
  const std::string wanted = "{\"id\":" + std::to_string(id) + ",";
  std::string answer;
  while (answer.empty()) {
    pollfd readable{socket_, POLLIN, 0};
    if (poll(&readable, 1, 5000) != 1) return {};
    const bool open = receive([&](bool binary, std::string_view payload) {
      if (!binary && payload.starts_with(wanted)) answer = payload;
    });
    if (!open) break;
  }
  return answer;
}

}  // namespace flexrf::bench
