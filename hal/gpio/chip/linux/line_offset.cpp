#include "hal/gpio/chip/linux/line_offset.hpp"

#include <charconv>
#include <optional>
#include <string_view>

#include "hal/gpio/chip/linux/gpio_messages.hpp"

namespace flexrf {
namespace {

std::optional<unsigned> as_offset(std::string_view text) {
  if (text.starts_with('#')) text.remove_prefix(1);
  unsigned offset = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), offset);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return offset;
}

}  // namespace

Result<unsigned> offset_of_line(const char* chip, const char* line, unsigned count,
                                const std::function<std::string(unsigned)>& name_of) {
  if (*line == '\0') return has_no_line(chip, line);
  std::optional<unsigned> found;
  for (unsigned offset = 0; offset < count; ++offset) {
    if (name_of(offset) != line) continue;
    if (found) return is_a_double_name(chip, line, *found, offset);
    found = offset;
  }
  if (!found) found = as_offset(line);
  if (!found) return has_no_line(chip, line);
  if (*found >= count) return has_fewer_lines(chip, line, count);
  return *found;
}

}  // namespace flexrf
