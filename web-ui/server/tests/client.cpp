#include "web-ui/server/tests/client.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>

namespace flexrf::panel {
namespace {

/// Again where it was interrupted: a process that is stopped and goes on finds its calls with a time limit
/// ended.
template <class Call>
ssize_t uninterrupted(Call&& call) {
  ssize_t count = 0;
  do {
    count = call();
  } while (count < 0 && errno == EINTR);
  return count;
}

}  // namespace

bool Client::connect(std::uint16_t port, const char* from) {
  close();
  input_.clear();
  socket_ = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  const timeval patience{20, 0};
  setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof(patience));
  setsockopt(socket_, SOL_SOCKET, SO_SNDTIMEO, &patience, sizeof(patience));
  sockaddr_in address{};
  address.sin_family = AF_INET;
  inet_pton(AF_INET, from, &address.sin_addr);
  if (bind(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) != 0) return false;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  return ::connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0;
}

void Client::close() {
  if (socket_ >= 0) ::close(socket_);
  socket_ = -1;
}

void Client::finish() {
  shutdown(socket_, SHUT_WR);
}

void Client::narrow() {
  const int size = 4096;
  setsockopt(socket_, SOL_SOCKET, SO_RCVBUF, &size, sizeof(size));
}

bool Client::send(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count =
        uninterrupted([&] { return ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL); });
    if (count <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
  return true;
}

bool Client::receive() {
  static char buffer[65536];
  const ssize_t count = uninterrupted([&] { return recv(socket_, buffer, sizeof(buffer), 0); });
  if (count <= 0) return false;
  input_.append(buffer, static_cast<std::size_t>(count));
  return true;
}

std::string Client::reply(bool has_body) {
  std::size_t end = 0;
  while ((end = input_.find("\r\n\r\n")) == std::string::npos) {
    if (!receive()) return {};
  }
  std::size_t size = end + 4;
  const std::size_t length = input_.find("Content-Length: ");
  if (has_body && length < end) size += std::strtoul(input_.c_str() + length + 16, nullptr, 10);
  while (input_.size() < size) {
    if (!receive()) return {};
  }
  std::string text = input_.substr(0, size);
  input_.erase(0, size);
  return text;
}

bool Client::ends() {
  while (receive()) input_.clear();
  // Not for want of patience: then the connection is there still.
  return errno != EAGAIN && errno != EWOULDBLOCK;
}

std::string Client::upgrade(const char* subprotocol, std::string_view more) {
  std::string text =
      "GET /api/v1/live HTTP/1.1\r\nHost: panel.test\r\nConnection: Upgrade\r\nUpgrade: websocket\r\n"
      "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n";
  if (subprotocol != nullptr) text += "Sec-WebSocket-Protocol: " + std::string{subprotocol} + "\r\n";
  send(text + std::string{more} + "\r\n");
  return reply();
}

bool Client::send_frame(std::uint8_t first_byte, std::string_view payload, bool masked) {
  constexpr std::string_view key = "\x12\x34\x56\x78";
  std::string frame(1, static_cast<char>(first_byte));
  const unsigned mask_bit = masked ? 0x80U : 0U;
  if (payload.size() < 126) {
    frame += static_cast<char>(mask_bit | payload.size());
  } else {
    frame += static_cast<char>(mask_bit | (payload.size() < 65536 ? 126U : 127U));
    const int bytes = payload.size() < 65536 ? 2 : 8;
    for (int i = bytes - 1; i >= 0; --i) frame += static_cast<char>((payload.size() >> (8 * i)) & 0xFFU);
  }
  if (masked) frame += key;
  for (std::size_t i = 0; i < payload.size(); ++i) {
    frame += masked ? static_cast<char>(payload[i] ^ key[i % 4]) : payload[i];
  }
  return send(frame);
}

Client::Frame Client::frame() {
  const auto byte = [this](std::size_t i) { return static_cast<std::uint8_t>(input_[i]); };
  while (input_.size() < 2) {
    if (!receive()) return {};
  }
  std::size_t header = 2;
  std::uint64_t size = byte(1) & 0x7FU;
  const std::size_t bytes = size == 126 ? 2 : size == 127 ? 8 : 0;
  header += bytes;
  while (input_.size() < header) {
    if (!receive()) return {};
  }
  if (bytes > 0) size = 0;
  for (std::size_t i = 0; i < bytes; ++i) size = size << 8U | byte(2 + i);
  while (input_.size() < header + size) {
    if (!receive()) return {};
  }
  Frame frame{byte(0), input_.substr(header, size)};
  input_.erase(0, header + size);
  return frame;
}

std::uint16_t Client::Frame::close_code() const {
  if (first_byte != 0x88 || payload.size() < 2) return 0;
  return static_cast<std::uint16_t>(static_cast<std::uint8_t>(payload[0]) << 8U |
                                    static_cast<std::uint8_t>(payload[1]));
}

std::uint16_t Client::close_code() {
  for (Frame next = frame(); next.first_byte != 0; next = frame()) {
    if (next.first_byte == 0x88) return next.close_code();
  }
  return 0;
}

std::string get(std::string_view path, std::string_view more) {
  return "GET " + std::string{path} + " HTTP/1.1\r\nHost: panel.test\r\n" + std::string{more} + "\r\n";
}

std::string post(std::string_view path, std::string_view body, std::string_view content_type) {
  return "POST " + std::string{path} +
         " HTTP/1.1\r\nHost: panel.test\r\nContent-Type: " + std::string{content_type} +
         "\r\nContent-Length: " + std::to_string(body.size()) + "\r\n\r\n" + std::string{body};
}

unsigned status_of(std::string_view reply) {
  if (!reply.starts_with("HTTP/1.1 ")) return 0;
  return static_cast<unsigned>(std::strtoul(std::string{reply.substr(9, 3)}.c_str(), nullptr, 10));
}

bool has(std::string_view text, std::string_view part) {
  return text.find(part) != std::string_view::npos;
}

std::string body_of_text(std::string_view reply) {
  const std::size_t end = reply.find("\r\n\r\n");
  return end == std::string_view::npos ? std::string{} : std::string{reply.substr(end + 4)};
}

}  // namespace flexrf::panel
