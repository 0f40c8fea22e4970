// Why something that somebody asked for was not done, in the words that every door shows.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "base/status.hpp"
#include "base/time.hpp"

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
  /// What is wrong. Ends without a full stop where a hint follows.
  [[gnu::format(printf, 2, 3)]] static Refusal make(RefusalKind kind, const char* format, ...) noexcept;

  /// What to do about it.
  [[gnu::format(printf, 2, 3)]] Refusal& hint(const char* format, ...) noexcept;
  /// "did you mean 'x'?"
  Refusal& hint_nearest(std::string_view name) noexcept;
  /// The parameter's path that it is about.
  Refusal& about(std::string_view parameter) noexcept;
  /// What the component itself said.
  Refusal& because(std::string_view reason) noexcept;
  /// Name of what moves; it lives for ever.
  Refusal& moving(const char* name) noexcept;

  RefusalKind kind() const noexcept { return kind_; }
  const char* text() const noexcept { return text_; }
  const char* hint() const noexcept { return hint_; }
  /// Text and hint in one sentence.
  const char* detail() const noexcept { return detail_; }
  const char* parameter() const noexcept { return parameter_; }
  const char* reason() const noexcept { return reason_; }
  std::span<const char* const> moving() const noexcept { return {moving_, moving_count_}; }

 private:
  static constexpr std::size_t most_moving = 16;

  void compose() noexcept;

  RefusalKind kind_ = RefusalKind::bad_request;
  char text_[480] = {};
  char hint_[120] = {};
  char detail_[608] = {};
  char parameter_[96] = {};
  char reason_[240] = {};
  const char* moving_[most_moving] = {};
  std::size_t moving_count_ = 0;
};

/// "There is no slot 'posse'; did you mean 'pose'?" `nearest` empty: `otherwise` says what to do.
Refusal no_such(const char* what, std::string_view name, std::string_view nearest,
                const char* otherwise) noexcept;

// Why values that somebody asked to save are not in the configuration file.

Refusal saving_already() noexcept;
/// wrong_state: it cannot be tried; not_stored: it failed.
Refusal not_saved(RefusalKind kind, const Status& cause) noexcept;
/// Within this time.
Refusal no_answer_of_disk(Duration waited) noexcept;

}  // namespace flexrf
