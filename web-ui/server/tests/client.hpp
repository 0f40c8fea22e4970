// A client that says exactly what a test wants it to, right or wrong.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace flexrf::panel {

/// Waits at most 20 s for anything, which is then missing. Not a leak where a failing assertion jumps: it
/// lives in the fixture.
class Client {
 public:
  Client() = default;
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;
  ~Client() { close(); }

  /// `from`: a numeric address of this machine.
  bool connect(std::uint16_t port, const char* from = "127.0.0.1");
  void close();
  /// No more will come from here, but all can be read.
  void finish();
  bool send(std::string_view bytes);
  /// Takes little of what comes before it lets the other side wait.
  void narrow();

  /// All of one reply: header and body by its Content-Length. Empty: the connection ended, or nothing came.
  std::string reply(bool has_body = true);
  /// True: the other side ended the connection; what came before is dropped.
  bool ends();

  // ---- WebSocket
  /// Null subprotocol: none. @returns the reply's header.
  std::string upgrade(const char* subprotocol = "flexrf.v1", std::string_view more = {});
  bool send_frame(std::uint8_t first_byte, std::string_view payload, bool masked = true);
  bool send_text(std::string_view text) { return send_frame(0x81, text); }
  struct Frame {
    std::uint8_t first_byte = 0;  ///< 0: none came
    std::string payload;
    std::uint16_t close_code() const;
  };
  Frame frame();
  /// Leaves out everything before a close frame; 0: none came.
  std::uint16_t close_code();

 private:
  bool receive();

  int socket_ = -1;
  std::string input_;
};

/// "GET PATH HTTP/1.1" with the host that the fixture's gate knows.
std::string get(std::string_view path, std::string_view more = {});
std::string post(std::string_view path, std::string_view body,
                 std::string_view content_type = "application/json");
/// The number in a status line; 0: there is none.
unsigned status_of(std::string_view reply);
bool has(std::string_view text, std::string_view part);
std::string body_of_text(std::string_view reply);

}  // namespace flexrf::panel
