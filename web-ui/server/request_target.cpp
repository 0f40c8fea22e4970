#include "web-ui/server/request_target.hpp"

#include <cstddef>

#include "base/ascii.hpp"

namespace flexrf::panel {
namespace {

std::string_view trim(std::string_view text) noexcept {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
  return text;
}

/// Takes the first element off a list.
std::string_view take_until(std::string_view& list, char mark) noexcept {
  const std::size_t end = list.find(mark);
  const std::string_view element = list.substr(0, end);
  list = end == std::string_view::npos ? std::string_view{} : list.substr(end + 1);
  return trim(element);
}

bool has_dot_segment(std::string_view path) noexcept {
  while (!path.empty()) {
    const std::size_t end = path.find('/');
    const std::string_view segment = path.substr(0, end);
    if (segment == "." || segment == "..") return true;
    path = end == std::string_view::npos ? std::string_view{} : path.substr(end + 1);
  }
  return false;
}

}  // namespace

std::optional<RequestTarget> decode_target(std::string_view target, char* memory) noexcept {
  if (target.empty() || target.front() != '/') return std::nullopt;
  RequestTarget result;
  const std::size_t mark = target.find('?');
  if (mark != std::string_view::npos) result.query = target.substr(mark + 1);
  const std::string_view path = target.substr(0, mark);
  std::size_t size = 0;
  for (std::size_t i = 0; i < path.size(); ++i) {
    char character = path[i];
    if (character == '%') {
      if (i + 2 >= path.size()) return std::nullopt;
      const int high = hexadecimal_digit(path[i + 1]);
      const int low = hexadecimal_digit(path[i + 2]);
      if (high < 0 || low < 0) return std::nullopt;
      character = static_cast<char>(high * 16 + low);
      i += 2;
    }
    if (static_cast<unsigned char>(character) < 0x20 || character == 0x7F || character == '\\') {
      return std::nullopt;
    }
    memory[size++] = character;
  }
  result.path = {memory, size};
  if (has_dot_segment(result.path)) return std::nullopt;
  return result;
}

bool accepts_gzip(std::string_view accept_encoding) noexcept {
  while (!accept_encoding.empty()) {
    std::string_view element = take_until(accept_encoding, ',');
    const std::string_view name = take_until(element, ';');
    if (!equal_without_case(name, "gzip") && name != "*") continue;
    const std::string_view weight = trim(element);
    // "q=0", "q=0.0": not at all.
    return !weight.starts_with("q=0") || weight.find_first_of("123456789") != std::string_view::npos;
  }
  return false;
}

bool is_media_type(std::string_view content_type, std::string_view type) noexcept {
  return equal_without_case(take_until(content_type, ';'), type);
}

bool list_has(std::string_view list, std::string_view name) noexcept {
  while (!list.empty()) {
    if (take_until(list, ',') == name) return true;
  }
  return false;
}

bool names_tag(std::string_view field, std::string_view tag) noexcept {
  while (!field.empty()) {
    std::string_view element = take_until(field, ',');
    if (element == "*") return true;
    if (element.starts_with("W/")) element.remove_prefix(2);
    if (element == tag) return true;
  }
  return false;
}

}  // namespace flexrf::panel
