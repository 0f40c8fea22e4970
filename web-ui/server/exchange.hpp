// One HTTP request and its reply, as the panel's handlers see them; knows nothing of sockets.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "web-ui/server/access/address.hpp"

namespace flexrf::panel {

enum class Method : std::uint8_t { get, head, put, post, other };

/// Index of a session in SessionTable.
using SessionIndex = std::uint16_t;
inline constexpr SessionIndex no_session = 0xFFFF;

/// Views are valid while the call runs. What is absent is empty.
struct Request {
  std::uint32_t place = 0;  ///< of the connection
  Method method = Method::get;
  std::string_view path;   ///< percent-decoded, without query: "/api/v1/slots/joints"
  std::string_view query;  ///< as sent, without '?'
  std::string_view host;   ///< never empty
  std::string_view origin;
  std::string_view cookie;
  std::string_view body;
  std::string_view content_type;
  std::string_view if_match;
  std::string_view if_none_match;
  bool accepts_gzip = false;
  std::string_view remote_address;  ///< numeric
  Address local_end;                ///< of ours, where the connection arrived
  bool loopback = false;            ///< the remote end is this machine
  bool has_fetch_site = false;      ///< Sec-Fetch-Site is there: a browser asks
  bool upgrade = false;             ///< wants to become a WebSocket
  SessionIndex session = no_session;
};

/// Belongs to a connection, which reuses its memory: a handler appends to `text`, or names bytes that live
/// for ever.
struct Reply {
  unsigned status = 200;
  std::string_view content_type = "application/json";
  std::string_view cache_control = "no-store";
  std::string_view content_encoding;  ///< "gzip", or none
  bool varies_by_encoding = false;    ///< the same path has another representation for other clients
  std::string_view allow;             ///< of a 405: "GET, HEAD"
  std::string_view location;          ///< of a redirection
  std::string etag;                   ///< quoted; empty: none
  std::string set_cookie;             ///< the whole value; empty: none
  unsigned retry_after = 0;           ///< s; 0: none
  std::string text;                   ///< the body, unless `fixed` is set
  std::string_view fixed;             ///< bytes that outlive the server
};

/// Names a reply that is not complete yet. Of a connection that is gone: reply_of() gives null.
struct Ticket {
  std::uint32_t connection = 0;
  std::uint32_t exchange = 0;
};

enum class Handled : std::uint8_t {
  now,    ///< the reply is complete
  later,  ///< somebody kept the ticket and will complete it
};

/// The server's side of a reply that came later. The server's thread.
class LaterReplies {
 public:
  virtual Reply* reply_of(Ticket ticket) = 0;  ///< null: the client is gone
  virtual void complete(Ticket ticket) = 0;    ///< sends it

 protected:
  ~LaterReplies() = default;
};

}  // namespace flexrf::panel
