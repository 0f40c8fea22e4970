#include "web-ui/server/access/cookie.hpp"

#include <charconv>

namespace flexrf::panel {
namespace {

std::string_view trimmed(std::string_view text) noexcept {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
  return text;
}

}  // namespace

std::string_view CookieValues::next() noexcept {
  while (!rest_.empty()) {
    const std::size_t end = rest_.find(';');
    const std::string_view pair = trimmed(rest_.substr(0, end));
    rest_ = end == std::string_view::npos ? std::string_view{} : rest_.substr(end + 1);
    const std::size_t equals = pair.find('=');
    if (equals != std::string_view::npos && pair.substr(0, equals) == name_) return pair.substr(equals + 1);
  }
  return {};
}

void write_set_cookie(std::string& text, std::string_view name, std::string_view value, Duration max_age,
                      bool secure) {
  char seconds[24];
  const auto count = std::chrono::duration_cast<std::chrono::seconds>(max_age).count();
  const std::size_t digits =
      static_cast<std::size_t>(std::to_chars(seconds, seconds + sizeof(seconds), count).ptr - seconds);
  text.assign(name).append("=").append(value).append("; Max-Age=");
  text.append(seconds, digits).append("; Path=/; HttpOnly; SameSite=Strict");
  if (secure) text.append("; Secure");
}

void write_forget_cookie(std::string& text, std::string_view name, bool secure) {
  write_set_cookie(text, name, "", Duration::zero(), secure);
}

}  // namespace flexrf::panel
