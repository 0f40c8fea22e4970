#include "base/quantity_text.hpp"

#include <array>
#include <charconv>
#include <cinttypes>
#include <cmath>
#include <cstdio>

namespace flexrf {
namespace {

struct Unit {
  const char* name;
  double size;  // in the smallest
};

constexpr std::array durations{Unit{"ns", 1},  Unit{"us", 1e3},   Unit{"ms", 1e6},
                               Unit{"s", 1e9}, Unit{"min", 60e9}, Unit{"h", 3600e9}};
constexpr std::array sizes{Unit{"B", 1}, Unit{"KiB", 1024}, Unit{"MiB", 1024.0 * 1024},
                           Unit{"GiB", 1024.0 * 1024 * 1024}};

/// Three significant digits, of what is below 1000.
std::string three_digits(double number, const char* unit) {
  char text[48];
  const double amount = std::fabs(number);
  const int decimals = amount < 9.995 ? 2 : amount < 99.95 ? 1 : 0;
  std::snprintf(text, sizeof(text), "%.*f %s", decimals, number, unit);
  return text;
}

template <std::size_t Count>
std::string quantity_text(double number, const std::array<Unit, Count>& units) {
  const double amount = std::fabs(number);
  // The smallest unit counts whole things.
  if (amount < units[1].size) {
    char text[48];
    std::snprintf(text, sizeof(text), "%.0f %s", number, units[0].name);
    return text;
  }
  std::size_t best = 1;
  // What would be rounded up to the next unit is shown in that.
  while (best + 1 < Count && amount >= 0.9995 * units[best + 1].size) ++best;
  return three_digits(number / units[best].size, units[best].name);
}

/// In the smallest unit.
template <std::size_t Count>
std::optional<std::uint64_t> parse_quantity(std::string_view text,
                                            const std::array<Unit, Count>& units) noexcept {
  constexpr double most = 9e18;
  constexpr double rounding = 1e-6;  // of 0.3 us in nanoseconds
  double number = 0;
  const auto [end, error] =
      std::from_chars(text.data(), text.data() + text.size(), number, std::chars_format::fixed);
  if (error != std::errc{} || !(number >= 0)) return std::nullopt;
  std::string_view name{end, static_cast<std::size_t>(text.data() + text.size() - end)};
  if (name.starts_with(' ')) name.remove_prefix(1);
  for (const Unit& unit : units) {
    if (unit.name != name) continue;
    const double value = number * unit.size;
    const double whole = std::round(value);
    if (whole > most || std::fabs(value - whole) > rounding) return std::nullopt;
    return static_cast<std::uint64_t>(whole);
  }
  return std::nullopt;
}

}  // namespace

std::string duration_text(Duration duration) {
  return quantity_text(static_cast<double>(duration.count()), durations);
}

std::string duration_if_any(Duration duration) {
  return duration.count() == 0 ? std::string{} : duration_text(duration);
}

std::string hexadecimal_text(std::uint64_t number) {
  char text[17];
  std::snprintf(text, sizeof(text), "%016" PRIx64, number);
  return text;
}

std::string size_text(std::uint64_t bytes) {
  return quantity_text(static_cast<double>(bytes), sizes);
}

std::optional<Duration> parse_duration(std::string_view text) noexcept {
  const std::optional<std::uint64_t> value = parse_quantity(text, durations);
  if (!value) return std::nullopt;
  return Duration{static_cast<Duration::rep>(*value)};
}

std::optional<std::uint64_t> parse_size(std::string_view text) noexcept {
  return parse_quantity(text, sizes);
}

}  // namespace flexrf
