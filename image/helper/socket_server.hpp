// The helper's socket: who may ask, and one answer to each request.
#pragma once

#include <sys/types.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/status.hpp"
#include "image/helper/desk.hpp"
#include "image/helper/request.hpp"
#include "runtime/json/json_reader.hpp"

namespace flexrf::helper {

struct SocketSettings {
  std::string path = "/run/flexrf-helper/socket";
  std::vector<uid_t> peers = {0};  ///< who may ask
};

/// What is done about requests. `state` is called by the thread of run(), the others by one of their own.
struct Service {
  std::function<std::string()> state;  ///< the answer
  std::function<Answer(const Request& request, const std::string& peer)> perform;
  std::function<void()> tick;  ///< about once a second
  std::function<void(const std::string& line)> say;
};

/// A Unix socket of messages (SOCK_SEQPACKET), which its owner and its group may use. No client is waited
/// for.
class SocketServer {
 public:
  static constexpr std::uint32_t most_connections = 8;

  SocketServer(SocketSettings settings, Service service);
  ~SocketServer();
  SocketServer(const SocketServer&) = delete;
  SocketServer& operator=(const SocketServer&) = delete;

  /// Until stop(). If there can be no socket it says why and tries again; the desk works all the same.
  void run();
  /// Any thread.
  void stop();

 private:
  struct Connection {
    int socket = -1;
    bool waits = false;  // for its answer; with a closed socket its place is taken until then
    std::string peer;
  };

  Status listen();
  void accept_one();
  void refuse_connection(int socket, const Answer& answer, const std::string& peer);
  void receive(std::uint32_t place);
  void send(Connection& connection, std::string_view text);
  void deliver();
  void close_socket(Connection& connection);
  void wake() noexcept;

  SocketSettings settings_;
  Service service_;
  JsonReader reader_;
  std::array<Connection, most_connections> connections_;
  std::array<char, longest_message + 1> message_{};
  int listener_ = -1;
  int wake_ = -1;
  std::string said_;  // about refused connections and the socket, so that it is said once
  std::atomic<bool> has_to_end_ = false;
  std::optional<Desk> desk_;
};

}  // namespace flexrf::helper
