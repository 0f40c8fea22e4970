#include "runtime/face/refusal.hpp"

#include <algorithm>
#include <cstdarg>
#include <cstdio>

namespace flexrf {
namespace {

struct Known {
  unsigned status;
  const char* type;
  const char* title;
  unsigned retry_after;
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

const Known& of(RefusalKind kind) noexcept {
  return known[static_cast<std::size_t>(kind)];
}

void copy(char* to, std::size_t capacity, std::string_view text) noexcept {
  const std::size_t size = std::min(text.size(), capacity - 1);
  std::copy_n(text.data(), size, to);
  to[size] = '\0';
}

}  // namespace

Refusal Refusal::make(RefusalKind kind, const char* format, ...) noexcept {
  Refusal refusal;
  refusal.kind_ = kind;
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(refusal.detail_, sizeof(refusal.detail_), format, arguments);
  va_end(arguments);
  return refusal;
}

Refusal& Refusal::about(std::string_view parameter) noexcept {
  copy(parameter_, sizeof(parameter_), parameter);
  return *this;
}

Refusal& Refusal::because(std::string_view reason) noexcept {
  copy(reason_, sizeof(reason_), reason);
  return *this;
}

Refusal& Refusal::moving(const char* name) noexcept {
  if (moving_count_ < most_moving) moving_[moving_count_++] = name;
  return *this;
}

unsigned Refusal::status() const noexcept {
  return of(kind_).status;
}

unsigned Refusal::retry_after() const noexcept {
  return of(kind_).retry_after;
}

void Refusal::write(JsonWriter& json) const {
  const Known& kind = of(kind_);
  json.begin_object().member("type", kind.type).member("title", kind.title).member("status", kind.status);
  json.member("detail", static_cast<const char*>(detail_));
  if (parameter_[0] != '\0') json.member("parameter", static_cast<const char*>(parameter_));
  if (reason_[0] != '\0') json.member("reason", static_cast<const char*>(reason_));
  if (moving_count_ > 0) {
    json.key("moving").begin_array();
    for (std::size_t i = 0; i < moving_count_; ++i) json.value(moving_[i]);
    json.end_array();
  }
  json.end_object();
}

}  // namespace flexrf
