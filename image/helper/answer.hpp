// What the helper says to a request.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "base/status.hpp"

namespace flexrf::helper {

/// Status as HTTP has it: 200 done; 400 no such request; 403 not this user; 404 no such upload; 409 not now,
/// as the state does not allow it; 413 too large; 429 too early; 503 something does not answer; 507 no room.
struct Answer {
  unsigned status = 200;
  std::string why;                        ///< when refused: what is wrong and what to do
  unsigned retry_after_s = 0;             ///< with 429
  std::string upload;                     ///< to `upload`: the token
  std::optional<std::uint64_t> received;  ///< to `part`: bytes so far, also with 409
  std::optional<std::uint64_t> freed;     ///< to `make-room`: bytes

  bool is_done() const noexcept { return status == 200; }
  /// As a JSON object.
  std::string text() const;
};

/// A refusal.
inline Answer refuse(unsigned status, std::string why) {
  return {status, std::move(why), 0, {}, {}, {}};
}

/// What could not be done is refused with 503.
inline Answer answer_of(const Status& status) {
  return status ? Answer{} : refuse(503, status.cause());
}

/// As somebody sent it, within a message.
inline std::string in_quotes(std::string_view text) {
  return '\'' + std::string{text.substr(0, 32)} + '\'';
}

}  // namespace flexrf::helper
