// Why something was not done, as RFC 9457 tells it.
#pragma once

#include <cstdint>
#include <string_view>

#include "runtime/core/json_writer.hpp"

namespace flexrf {

enum class RefusalKind : std::uint8_t {
  bad_request,
  role_missing,
  control_missing,
  not_found,
  method_not_allowed,
  wrong_state,
  moving,
  stale,
  too_large,
  wrong_media_type,
  refused,
  busy,
  no_answer,
  not_stored,
};

/// Never allocates; texts are cut at their capacity.
class Refusal {
 public:
  [[gnu::format(printf, 2, 3)]] static Refusal make(RefusalKind kind, const char* format, ...) noexcept;

  /// The parameter's path that it is about.
  Refusal& about(std::string_view parameter) noexcept;
  /// What the component itself said.
  Refusal& because(std::string_view reason) noexcept;
  /// Name of what moves; it lives for ever.
  Refusal& moving(const char* name) noexcept;

  const char* detail() const noexcept { return detail_; }
  unsigned status() const noexcept;
  /// One JSON object.
  void write(JsonWriter& json) const;
  /// Seconds after which to try again; 0: trying again does not help.
  unsigned retry_after() const noexcept;

 private:
  static constexpr std::size_t most_moving = 16;

  RefusalKind kind_ = RefusalKind::bad_request;
  char detail_[480] = {};
  char parameter_[96] = {};
  char reason_[240] = {};
  const char* moving_[most_moving] = {};
  std::size_t moving_count_ = 0;
};

}  // namespace flexrf
