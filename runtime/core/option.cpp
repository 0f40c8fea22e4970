#include "runtime/core/option.hpp"

#include <charconv>
#include <cmath>

#include "base/quantity_text.hpp"

namespace flexrf {
namespace {

std::optional<double> parse_number(std::string_view text) noexcept {
  double number = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc{} || stop != end || !std::isfinite(number)) return std::nullopt;
  return number;
}

/// One word, as everything that follows an option.
std::optional<Duration> parse_word(std::string_view text) noexcept {
  if (text.find(' ') != std::string_view::npos) return std::nullopt;
  const std::optional<Duration> duration = parse_duration(text);
  return duration && duration->count() > 0 ? duration : std::nullopt;
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
  if (option.kind == OptionKind::duration && !parse_word(value)) {
    return Status::error(StatusCode::invalid_argument,
                         "%s %s: give a duration with its unit (ns, us, ms, s, min, h), as `60s`",
                         option.name, value);
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
  return parse_word(text(name, ""));
}

}  // namespace flexrf
