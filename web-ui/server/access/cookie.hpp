// The session's cookie as HTTP writes it (RFC 6265).
#pragma once

#include <string>
#include <string_view>

#include "base/time.hpp"

namespace flexrf::panel {

/// Walks through the values that a Cookie header gives under one name; a browser may send several.
class CookieValues {
 public:
  /// Both must outlive it.
  CookieValues(std::string_view header, std::string_view name) noexcept : rest_(header), name_(name) {}
  /// Null data: there is no further one.
  std::string_view next() noexcept;

 private:
  std::string_view rest_;
  std::string_view name_;
};

/// What Set-Cookie says: HttpOnly, SameSite=Strict, Path=/, and Secure when `secure`. Replaces `text`, whose
/// memory is kept.
void write_set_cookie(std::string& text, std::string_view name, std::string_view value, Duration max_age,
                      bool secure);
/// The same for a cookie that is to be forgotten.
void write_forget_cookie(std::string& text, std::string_view name, bool secure);

}  // namespace flexrf::panel
