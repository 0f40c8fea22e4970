#include "image/helper/socket_server.hpp"

#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <optional>
#include <utility>
#include <variant>

namespace flexrf::helper {
namespace {

constexpr int until_next_try_ms = 2'000;  // to make a socket that could not be made

Status failure(const char* act, const std::string& path) {
  return Status::error(StatusCode::unavailable, "the socket %s cannot be %s, so nobody can ask anything: %s",
                       path.c_str(), act, strerrordesc_np(errno));
}

std::string text_of(const ucred& peer) {
  return "uid " + std::to_string(peer.uid) + ", process " + std::to_string(peer.pid);
}

bool is_again(int error) noexcept {
  return error == EAGAIN || error == EINTR;
}

}  // namespace

SocketServer::SocketServer(SocketSettings settings, Service service)
    : settings_(std::move(settings)),
      service_(std::move(service)),
      wake_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
  desk_.emplace([this](const Desk::Task& task) { return service_.perform(task.request, task.peer); },
                [this] { service_.tick(); }, [this] { wake(); });
}

SocketServer::~SocketServer() {
  desk_.reset();  // it uses what follows
  for (Connection& connection : connections_) close_socket(connection);
  if (listener_ >= 0) close(listener_);
  if (wake_ >= 0) close(wake_);
}

void SocketServer::run() {
  while (!has_to_end_) {
    if (listener_ < 0) {
      const Status made = listen();
      if (!made && said_ != made.cause()) service_.say(said_ = made.cause());
    }
    std::array<pollfd, most_connections + 2> polled{};
    for (std::uint32_t i = 0; i < most_connections; ++i) {
      // Who waits for an answer asks nothing else meanwhile; that he is gone is told all the same.
      const short wanted = connections_[i].waits ? 0 : POLLIN;
      polled[i] = {connections_[i].socket, wanted, 0};
    }
    polled[most_connections] = {listener_, POLLIN, 0};
    polled[most_connections + 1] = {wake_, POLLIN, 0};
    if (poll(polled.data(), polled.size(), listener_ < 0 ? until_next_try_ms : -1) < 0 && errno != EINTR) {
      service_.say(std::string{"the socket is not served any more: "} + strerrordesc_np(errno));
      return;
    }
    if (polled[most_connections + 1].revents != 0) deliver();
    for (std::uint32_t i = 0; i < most_connections; ++i) {
      if (polled[i].revents == 0 || polled[i].fd != connections_[i].socket) continue;
      if (connections_[i].waits) {
        if ((polled[i].revents & (POLLHUP | POLLERR)) != 0) close_socket(connections_[i]);
      } else {
        receive(i);
      }
    }
    if (polled[most_connections].revents != 0) accept_one();
  }
}

void SocketServer::stop() {
  has_to_end_ = true;
  wake();
}

void SocketServer::wake() noexcept {
  const std::uint64_t one = 1;
  [[maybe_unused]] const ssize_t written = write(wake_, &one, sizeof(one));
}

Status SocketServer::listen() {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (settings_.path.size() >= sizeof(address.sun_path)) {
    errno = ENAMETOOLONG;
    return failure("made", settings_.path);
  }
  settings_.path.copy(address.sun_path, sizeof(address.sun_path) - 1);
  const int made = socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  if (made < 0) return failure("made", settings_.path);
  // Of a helper before this one: nobody listens there any more.
  unlink(settings_.path.c_str());
  if (bind(made, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) != 0 ||
      chmod(settings_.path.c_str(), 0660) != 0 || ::listen(made, most_connections) != 0) {
    const Status why = failure("made", settings_.path);
    close(made);
    return why;
  }
  listener_ = made;
  return {};
}

void SocketServer::accept_one() {
  const int socket = accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK);
  if (socket < 0) return;  // who came is gone again, or there will be room for him when others are
  ucred peer{};
  socklen_t size = sizeof(peer);
  if (getsockopt(socket, SOL_SOCKET, SO_PEERCRED, &peer, &size) != 0) {
    close(socket);
    return;
  }
  if (std::find(settings_.peers.begin(), settings_.peers.end(), peer.uid) == settings_.peers.end())
    return refuse_connection(
        socket, refuse(403, "only root and the application's user may ask this; ask the application's panel"),
        text_of(peer));
  auto* const place = std::find_if(connections_.begin(), connections_.end(),
                                   [](const Connection& one) { return one.socket < 0 && !one.waits; });
  if (place == connections_.end())
    return refuse_connection(socket, refuse(503, "there are 8 connections already; close one"),
                             text_of(peer));
  *place = {socket, false, text_of(peer)};
}

void SocketServer::refuse_connection(int socket, const Answer& answer, const std::string& peer) {
  if (const std::string line = "a connection of " + peer + " is refused: " + answer.why; line != said_)
    service_.say(said_ = line);
  const std::string text = answer.text();
  ::send(socket, text.data(), text.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
  // With a request unread, closing would be an error to who has not read the answer yet.
  shutdown(socket, SHUT_RD);
  while (recv(socket, message_.data(), message_.size(), MSG_DONTWAIT) > 0) continue;
  close(socket);
}

void SocketServer::receive(std::uint32_t place) {
  Connection& connection = connections_[place];
  const ssize_t count = recv(connection.socket, message_.data(), message_.size(), MSG_DONTWAIT);
  if (count < 0 && is_again(errno)) return;
  if (count <= 0) return close_socket(connection);
  const auto size = static_cast<std::size_t>(count);
  if (size > longest_message)
    return send(
        connection,
        refuse(413, "a request has a line of at most 1 KiB and a part of at most 60 KiB; send smaller ones")
            .text());
  auto parsed = parse_request(reader_, {message_.data(), size});
  if (const Answer* const refusal = std::get_if<Answer>(&parsed)) return send(connection, refusal->text());
  auto& request = std::get<Request>(parsed);
  if (request.verb == Verb::state) return send(connection, service_.state());
  connection.waits = true;
  desk_->hand_in({place, connection.peer, std::move(request)});
}

void SocketServer::send(Connection& connection, std::string_view text) {
  // Who does not take his answers has none of the next.
  if (::send(connection.socket, text.data(), text.size(), MSG_DONTWAIT | MSG_NOSIGNAL) !=
      static_cast<ssize_t>(text.size()))
    close_socket(connection);
}

void SocketServer::deliver() {
  std::uint64_t count = 0;
  [[maybe_unused]] const ssize_t read_bytes = read(wake_, &count, sizeof(count));
  while (const std::optional<Desk::Done> done = desk_->take()) {
    Connection& connection = connections_[done->place];
    connection.waits = false;
    if (connection.socket >= 0) send(connection, done->answer.text());
  }
}

void SocketServer::close_socket(Connection& connection) {
  if (connection.socket >= 0) close(connection.socket);
  connection.socket = -1;
}

}  // namespace flexrf::helper
