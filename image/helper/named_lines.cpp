#include "image/helper/named_lines.hpp"

#include <charconv>

#include "runtime/parameters/durable_file.hpp"

namespace flexrf::helper {

NamedLines NamedLines::of(std::string_view text) {
  NamedLines lines;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    const std::string_view line = text.substr(0, end);
    text = end == std::string_view::npos ? std::string_view{} : text.substr(end + 1);
    const std::size_t sign = line.find('=');
    if (sign == std::string_view::npos) continue;
    lines.values_[std::string{line.substr(0, sign)}] = line.substr(sign + 1);
  }
  return lines;
}

Result<NamedLines> NamedLines::read(const std::string& file) {
  const Result<std::string> text = read_file(file);
  if (!text) return text.status();
  return of(*text);
}

std::string NamedLines::text(std::string_view name) const {
  return whole(name).substr(0, longest_value);
}

std::string NamedLines::whole(std::string_view name) const {
  const auto found = values_.find(name);
  return found == values_.end() ? std::string{} : found->second;
}

std::uint64_t NamedLines::number(std::string_view name) const {
  const std::string value = text(name);
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
  return error == std::errc{} && end == value.data() + value.size() ? number : 0;
}

}  // namespace flexrf::helper
