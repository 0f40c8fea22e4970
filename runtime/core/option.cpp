#include "runtime/core/option.hpp"

#include <charconv>
#include <cmath>

namespace flexrf {
namespace {

std::optional<double> parse_number(std::string_view text) noexcept {
  double number = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc{} || stop != end || !std::isfinite(number)) return std::nullopt;
  return number;
}

std::optional<Duration> parse_duration(std::string_view text) noexcept {
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || !(number > 0)) return std::nullopt;
  const std::string_view unit{end, static_cast<std::size_t>(text.data() + text.size() - end)};
  double scale = 0;
  if (unit == "h") scale = 3600e9;
  if (unit == "min") scale = 60e9;
  if (unit == "s") scale = 1e9;
  if (unit == "ms") scale = 1e6;
  if (unit == "us") scale = 1e3;
  if (scale == 0 || number * scale > 9e18 || number * scale < 1) return std::nullopt;
  return Duration{static_cast<std::int64_t>(number * scale)};
}

Status no_number(const Option& option, const char* value) noexcept {
  char range[80] = "";
  if (std::isfinite(option.least))
    std::snprintf(range, sizeof(range), " from %g to %g", option.least, option.most);
  return Status::error(StatusCode::invalid_argument, "%s %s: give a number%s%s%s", option.name, value, range,
                       option.unit[0] == '\0' ? "" : ", in ", option.unit);
}

}  // namespace

Status check_value(const Option& option, const char* value) noexcept {
  if (option.kind == OptionKind::number) {
    const std::optional<double> number = parse_number(value);
    if (!number || *number < option.least || *number > option.most) return no_number(option, value);
  }
  if (option.kind == OptionKind::duration && !parse_duration(value)) {
    return Status::error(StatusCode::invalid_argument,
                         "%s %s: give a duration with its unit (us, ms, s, min, h), as `60s`", option.name,
                         value);
  }
  return {};
}

const GivenOption* OptionValues::find(std::string_view name) const noexcept {
  for (std::size_t i = given_.size(); i > 0; --i) {
    if (name == given_[i - 1].option->name) return &given_[i - 1];
  }
  return nullptr;
}

const char* OptionValues::text(std::string_view name, const char* otherwise) const noexcept {
  const GivenOption* const given = find(name);
  return given == nullptr ? otherwise : given->value;
}

std::optional<double> OptionValues::number(std::string_view name) const noexcept {
  return parse_number(text(name, ""));
}

std::optional<Duration> OptionValues::duration(std::string_view name) const noexcept {
  return parse_duration(text(name, ""));
}

}  // namespace flexrf
