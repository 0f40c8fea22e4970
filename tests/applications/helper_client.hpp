// A client of flexrf-helper's socket.
#pragma once

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "tests/applications/helper_pc.hpp"

namespace flexrf::whole {

using nlohmann::json;

inline sockaddr_un address_of_socket(const Pc& pc) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  (pc.folder / "socket").copy(address.sun_path, sizeof(address.sun_path) - 1);
  return address;
}

/// A connection to the helper.
class Client {
 public:
  /// Waits until the helper listens.
  explicit Client(const Pc& pc) {
    CHECK(wait_until([&] { return connects(pc); }));
  }
  ~Client() { close(); }
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;

  bool sends(const std::string& message) const {
    return ::send(socket_, message.data(), message.size(), MSG_NOSIGNAL | MSG_DONTWAIT) ==
           static_cast<ssize_t>(message.size());
  }
  /// Nothing: the helper has closed.
  std::optional<json> receive() const {
    std::string text(1 << 16, '\0');
    const ssize_t size = recv(socket_, text.data(), text.size(), 0);
    if (size <= 0) return std::nullopt;
    return json::parse(text.substr(0, static_cast<std::size_t>(size)));
  }
  json ask(const std::string& message) const {
    CHECK(sends(message));
    const auto answer = receive();
    CHECK(answer.has_value());
    return *answer;
  }
  json ask(const json& members, const std::string& verb) const {
    json request = members;
    request["verb"] = verb;
    return ask(request.dump());
  }
  json part(const std::string& token, std::size_t offset, const std::string& bytes) const {
    const json line = {{"verb", "part"}, {"upload", token}, {"offset", offset}};
    return ask(line.dump() + '\n' + bytes);
  }
  void close() {
    if (socket_ >= 0) ::close(socket_);
    socket_ = -1;
  }

 private:
  bool connects(const Pc& pc) {
    close();
    socket_ = socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0);
    // More than anything here takes, but no stop without an end.
    const timeval patience{60, 0};
    setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof(patience));
    const sockaddr_un address = address_of_socket(pc);
    return connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0;
  }

  int socket_ = -1;
};

}  // namespace flexrf::whole
