#include "runtime/face/refusal.hpp"

#include <algorithm>
#include <cstdarg>
#include <cstdio>

#include "base/text.hpp"

namespace flexrf {

Refusal Refusal::make(RefusalKind kind, const char* format, ...) noexcept {
  Refusal refusal;
  refusal.kind_ = kind;
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(refusal.text_, sizeof(refusal.text_), format, arguments);
  va_end(arguments);
  refusal.compose();
  return refusal;
}

Refusal& Refusal::hint(const char* format, ...) noexcept {
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(hint_, sizeof(hint_), format, arguments);
  va_end(arguments);
  compose();
  return *this;
}

Refusal& Refusal::hint_nearest(std::string_view name) noexcept {
  return hint("did you mean '%.*s'?", static_cast<int>(name.size()), name.data());
}

Refusal no_such(const char* what, std::string_view name, std::string_view nearest,
                const char* otherwise) noexcept {
  Refusal refusal = Refusal::make(RefusalKind::not_found, "There is no %s '%.*s'", what,
                                  static_cast<int>(std::min<std::size_t>(name.size(), 80)), name.data());
  return nearest.empty() ? refusal.hint("%s", otherwise) : refusal.hint_nearest(nearest);
}

Refusal saving_already() noexcept {
  return Refusal::make(RefusalKind::busy, "The values are being saved already")
      .hint("wait until that is done");
}

Refusal not_saved(RefusalKind kind, const Status& cause) noexcept {
  return Refusal::make(kind, "The values were not saved: %s", cause.cause())
      .hint("they are in force all the same")
      .because(cause.cause());
}

Refusal no_answer_of_disk(Duration waited) noexcept {
  return Refusal::make(RefusalKind::no_answer,
                       "The disk of the configuration file did not answer within %.3g s", seconds(waited))
      .hint("the state says when the values are saved");
}

void Refusal::compose() noexcept {
  const std::string_view end = hint_[0] != '\0' ? hint_ : text_;
  const bool is_ended = end.ends_with('.') || end.ends_with('?');
  std::snprintf(detail_, sizeof(detail_), "%s%s%s%s", text_, hint_[0] != '\0' ? "; " : "", hint_,
                is_ended ? "" : ".");
}

Refusal& Refusal::about(std::string_view parameter) noexcept {
  copy_text(parameter_, parameter);
  return *this;
}

Refusal& Refusal::because(std::string_view reason) noexcept {
  copy_text(reason_, reason);
  return *this;
}

Refusal& Refusal::moving(const char* name) noexcept {
  if (moving_count_ < most_moving) moving_[moving_count_++] = name;
  return *this;
}

}  // namespace flexrf
