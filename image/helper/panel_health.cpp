#include "image/helper/panel_health.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <openssl/err.h>
#include <openssl/ssl.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <memory>
#include <string_view>
#include <system_error>
#include <utility>

#include "runtime/json/json_reader.hpp"

namespace flexrf::helper {
namespace {

constexpr std::size_t longest_answer = 4096;
constexpr std::size_t longest_reason = 200;

class Socket {
 public:
  explicit Socket(int number) noexcept : number_(number) {}
  Socket(const Socket&) = delete;
  Socket& operator=(const Socket&) = delete;
  ~Socket() {
    if (number_ >= 0) close(number_);
  }
  int number() const noexcept { return number_; }

 private:
  int number_;
};

std::string of_errno(const char* act) {
  return std::string("the panel cannot be ") + act + ": " +
         std::error_code(errno, std::generic_category()).message();
}

std::string of_encryption(const char* act) {
  const unsigned long error = ERR_peek_last_error();
  const char* const reason = error == 0 ? nullptr : ERR_reason_error_string(error);
  return std::string("the panel ") + act + ": " + (reason == nullptr ? "no answer in time" : reason);
}

bool connect_within(int socket_number, std::uint16_t port, Duration wait) {
  // Of connecting, sending and receiving alike.
  const auto microseconds = std::chrono::duration_cast<std::chrono::microseconds>(wait).count();
  const timeval limit{microseconds / 1'000'000, microseconds % 1'000'000};
  setsockopt(socket_number, SOL_SOCKET, SO_RCVTIMEO, &limit, sizeof(limit));
  setsockopt(socket_number, SOL_SOCKET, SO_SNDTIMEO, &limit, sizeof(limit));
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  return connect(socket_number, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0;
}

/// It comes from a process that may have been taken over, and goes to a terminal.
std::string made_printable(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char one) { return one < ' ' || one > '~'; }, '?');
  return text;
}

PanelAnswer answer_in(std::string_view text) {
  PanelAnswer answer;
  answer.has_answered = true;
  const std::size_t end_of_head = text.find("\r\n\r\n");
  const bool is_fine =
      text.starts_with("HTTP/1.") && text.substr(std::min<std::size_t>(text.size(), 8)).starts_with(" 200 ");
  JsonReader reader;
  const Result<JsonObject> body = end_of_head == std::string_view::npos
                                      ? Status::error(StatusCode::unavailable, "no body")
                                      : reader.object(text.substr(end_of_head + 4));
  std::string_view said;
  if (body) {
    // What is not there, or is no such thing, leaves the answer as it is.
    [[maybe_unused]] auto error = (*body)["may_move"].get(answer.may_move);
    error = (*body)["why_not"].get(said);
    if (said.empty()) error = (*body)["detail"].get(said);  // of who serves something else at this port
  }
  if (is_fine) return answer;
  if (said.empty()) said = text.substr(0, text.find("\r\n"));
  answer.why_not_healthy = made_printable("the panel says: " + std::string{said.substr(0, longest_reason)});
  return answer;
}

PanelAnswer without(std::string why) {
  return {std::move(why), false, true};
}

template <auto free>
struct Free {
  template <class Value>
  void operator()(Value* value) const noexcept {
    free(value);
  }
};

}  // namespace

PanelAnswer ask_panel(std::uint16_t port, const std::string& certificate_file, Duration wait) {
  ERR_clear_error();
  const std::unique_ptr<SSL_CTX, Free<SSL_CTX_free>> context(SSL_CTX_new(TLS_client_method()));
  if (!context) return without(of_encryption("cannot be asked"));
  // The certificate is trusted by itself, and whose name is in it does not matter.
  if (SSL_CTX_load_verify_locations(context.get(), certificate_file.c_str(), nullptr) != 1)
    return without("the panel's certificate " + certificate_file + " cannot be read");
  SSL_CTX_set_verify(context.get(), SSL_VERIFY_PEER, nullptr);
  // The PC's clock may be wrong, and the certificate may be one that another one signed.
  X509_VERIFY_PARAM_set_flags(SSL_CTX_get0_param(context.get()),
                              X509_V_FLAG_NO_CHECK_TIME | X509_V_FLAG_PARTIAL_CHAIN);
  SSL_CTX_set_min_proto_version(context.get(), TLS1_2_VERSION);

  const Socket connection(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
  if (connection.number() < 0) return without(of_errno("asked"));
  if (!connect_within(connection.number(), port, wait)) return without(of_errno("reached"));
  const std::unique_ptr<SSL, Free<SSL_free>> encryption(SSL_new(context.get()));
  if (!encryption || SSL_set_fd(encryption.get(), connection.number()) != 1 ||
      SSL_connect(encryption.get()) != 1)
    return without(of_encryption("has not proved who it is"));

  const std::string request = "GET /api/v1/health HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(port) +
                              "\r\nConnection: close\r\n\r\n";
  if (SSL_write(encryption.get(), request.data(), static_cast<int>(request.size())) <= 0)
    return without(of_encryption("takes no request"));
  std::array<char, longest_answer> answer{};
  std::size_t size = 0;
  const Time end = MonotonicClock::now() + wait;
  while (size < answer.size() && MonotonicClock::now() < end) {
    const int count =
        SSL_read(encryption.get(), answer.data() + size, static_cast<int>(answer.size() - size));
    if (count <= 0) break;
    size += static_cast<std::size_t>(count);
  }
  const std::string_view text(answer.data(), size);
  if (text.empty()) return without(of_encryption("does not answer"));
  return answer_in(text);
}

}  // namespace flexrf::helper
