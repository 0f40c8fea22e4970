#include "web-ui/server/http_problem.hpp"

#include <array>
#include <utility>

#include "base/json_writer.hpp"

namespace flexrf::panel {
namespace {

struct Title {
  unsigned status;
  std::string_view text;
};

// RFC 9110 and 4918, what this server uses.
constexpr std::array titles{
    Title{100, "Continue"},
    Title{200, "OK"},
    Title{204, "No Content"},
    Title{303, "See Other"},
    Title{304, "Not Modified"},
    Title{400, "Bad Request"},
    Title{401, "Unauthorized"},
    Title{403, "Forbidden"},
    Title{404, "Not Found"},
    Title{405, "Method Not Allowed"},
    Title{408, "Request Timeout"},
    Title{409, "Conflict"},
    Title{412, "Precondition Failed"},
    Title{413, "Content Too Large"},
    Title{415, "Unsupported Media Type"},
    Title{417, "Expectation Failed"},
    Title{421, "Misdirected Request"},
    Title{422, "Unprocessable Content"},
    Title{426, "Upgrade Required"},
    Title{429, "Too Many Requests"},
    Title{431, "Request Header Fields Too Large"},
    Title{500, "Internal Server Error"},
    Title{503, "Service Unavailable"},
    Title{504, "Gateway Timeout"},
    Title{505, "HTTP Version Not Supported"},
    Title{507, "Insufficient Storage"},
};

}  // namespace

std::string_view title_of(unsigned status) noexcept {
  for (const Title& title : titles) {
    if (title.status == status) return title.text;
  }
  return "Unknown";
}

void answer_problem(Reply& reply, unsigned status, std::string_view detail) {
  reply.status = status;
  reply.content_type = "application/problem+json";
  reply.content_encoding = {};
  reply.cache_control = "no-store";
  reply.etag.clear();
  reply.fixed = {};
  reply.text.clear();
  JsonWriter json(std::move(reply.text));
  json.begin_object().member("type", "about:blank").member("title", title_of(status));
  json.member("status", status).member("detail", detail).end_object();
  reply.text = json.release();
}

}  // namespace flexrf::panel
