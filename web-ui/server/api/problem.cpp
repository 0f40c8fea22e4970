#include "web-ui/server/api/problem.hpp"

#include <utility>

namespace flexrf::panel {
namespace {

struct Known {
  unsigned status;
  const char* type;
  const char* title;
  unsigned retry_after;  // s; 0: trying again does not help
};

/// In the order of RefusalKind.
constexpr Known known[] = {
    {400, "/problems/bad-request", "The request is not understood", 0},
    {403, "/problems/role-missing", "The session's role is too low", 0},
    {403, "/problems/control-missing", "The session does not hold the control token", 0},
    {404, "/problems/not-found", "There is no such thing", 0},
    {405, "/problems/method-not-allowed", "This method is not for this path", 0},
    {409, "/problems/wrong-state", "Not in this state", 0},
    {409, "/problems/moving", "Something moves", 0},
    {412, "/problems/stale", "The values have changed since", 0},
    {413, "/problems/too-large", "Too much for one request", 0},
    {415, "/problems/wrong-media-type", "The body is no JSON", 0},
    {422, "/problems/refused", "The value is refused", 0},
    {503, "/problems/busy", "Too much at a time", 1},
    {504, "/problems/no-answer", "The component does not answer", 1},
    {507, "/problems/not-stored", "The disk does not take it", 0},
};

const Known& of(const Refusal& refusal) noexcept {
  return known[static_cast<std::size_t>(refusal.kind())];
}

}  // namespace

void write_problem(JsonWriter& json, const Refusal& refusal) {
  const Known& kind = of(refusal);
  json.begin_object().member("type", kind.type).member("title", kind.title).member("status", kind.status);
  json.member("detail", refusal.detail());
  if (refusal.parameter()[0] != '\0') json.member("parameter", refusal.parameter());
  if (refusal.reason()[0] != '\0') json.member("reason", refusal.reason());
  if (!refusal.moving().empty()) {
    json.key("moving").begin_array();
    for (const char* const name : refusal.moving()) json.value(name);
    json.end_array();
  }
  json.end_object();
}

void write_problem(Reply& reply, const Refusal& refusal) {
  reply.status = of(refusal).status;
  reply.retry_after = of(refusal).retry_after;
  reply.content_type = "application/problem+json";
  reply.etag.clear();
  reply.fixed = {};
  reply.text.clear();
  JsonWriter json(std::move(reply.text));
  write_problem(json, refusal);
  reply.text = json.release();
}

}  // namespace flexrf::panel
