#include "web-ui/server/access/login_log.hpp"

#include <cstddef>

#include "base/text.hpp"
#include "runtime/log/log.hpp"

namespace flexrf::panel {
namespace {

constexpr std::size_t longest_shown = 32;  // bytes of the name

}  // namespace

ShownName shown_name(std::string_view name) noexcept {
  constexpr std::string_view digits = "0123456789abcdef";
  ShownName shown{};
  std::size_t end = 0;
  const auto add = [&](char character) { shown[end++] = character; };
  add('\'');
  for (const char character : name.substr(0, longest_shown)) {
    const auto byte = static_cast<unsigned char>(character);
    if (byte >= 0x20 && byte < 0x7f && character != '\'' && character != '\\') {
      add(character);
      continue;
    }
    add('\\');
    add('x');
    add(digits[byte >> 4U]);
    add(digits[byte & 15U]);
  }
  if (name.size() > longest_shown) {
    for (const char dot : {'.', '.', '.'}) add(dot);
  }
  add('\'');
  return shown;
}

void log_failed_login(const ShownName& name, std::string_view address) noexcept {
  static LogLimit limit;
  log_warning(limit, "panel", "{} from {} did not get in: user or password is wrong", text_view(name),
              address);
}

void log_failed_token(std::string_view address) noexcept {
  static LogLimit limit;
  log_warning(limit, "panel", "somebody from {} did not get in: the address's token is wrong or was used",
              address);
}

}  // namespace flexrf::panel
