#include "config-gen/read/quantities.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <iterator>

namespace flexrf::config_gen {
namespace {

// Exponents of m, kg, s, A, K, mol, cd, rad, px and B.
using Dimension = std::array<int, 10>;

struct UnitOfMeasure {
  std::string_view symbol;
  Dimension dimension;
  std::string_view si = {};   // empty: it is SI itself, or counted as if it were
  bool has_multiples = true;  // "mm", "kPa", "mbar"
};

constexpr UnitOfMeasure known_units[] = {
    {"1", {}, {}, false},
    {"m", {1}},
    {"kg", {0, 1}, {}, false},
    {"s", {0, 0, 1}},
    {"A", {0, 0, 0, 1}},
    {"K", {0, 0, 0, 0, 1}},
    {"mol", {0, 0, 0, 0, 0, 1}},
    {"cd", {0, 0, 0, 0, 0, 0, 1}},
    {"rad", {0, 0, 0, 0, 0, 0, 0, 1}},
    {"sr", {}},
    {"px", {0, 0, 0, 0, 0, 0, 0, 0, 1}},
    {"B", {0, 0, 0, 0, 0, 0, 0, 0, 0, 1}},
    {"bit", {0, 0, 0, 0, 0, 0, 0, 0, 0, 1}},
    {"dB", {}},
    {"Hz", {0, 0, -1}},
    {"N", {1, 1, -2}},
    {"Pa", {-1, 1, -2}},
    {"J", {2, 1, -2}},
    {"W", {2, 1, -3}},
    {"C", {0, 0, 1, 1}},
    {"V", {2, 1, -3, -1}},
    {"F", {-2, -1, 4, 2}},
    {"Ohm", {2, 1, -3, -2}},
    {"S", {-2, -1, 3, 2}},
    {"Wb", {2, 1, -2, -1}},
    {"T", {0, 1, -2, -1}},
    {"H", {2, 1, -2, -2}},
    {"lm", {0, 0, 0, 0, 0, 0, 1}},
    {"lx", {-2, 0, 0, 0, 0, 0, 1}},
    {"Bq", {0, 0, -1}},
    {"Gy", {2, 0, -2}},
    {"Sv", {2, 0, -2}},
    {"kat", {0, 0, -1, 0, 0, 1}},
    {"g", {0, 1}, "kg"},
    {"t", {0, 1}, "kg", false},
    {"l", {3}, "m^3"},
    {"in", {1}, "m", false},
    {"min", {0, 0, 1}, "s", false},
    {"h", {0, 0, 1}, "s", false},
    {"d", {0, 0, 1}, "s", false},
    {"deg", {0, 0, 0, 0, 0, 0, 0, 1}, "rad", false},
    {"rpm", {0, 0, -1, 0, 0, 0, 0, 1}, "rad/s", false},
    {"degC", {0, 0, 0, 0, 1}, "K", false},
    {"degF", {0, 0, 0, 0, 1}, "K", false},
    {"bar", {-1, 1, -2}, "Pa"},
    {"psi", {-1, 1, -2}, "Pa", false},
    {"Ah", {0, 0, 1, 1}, "C"},
    {"Wh", {2, 1, -2}, "J"},
    {"VA", {2, 1, -3}, "W"},
    {"var", {2, 1, -3}, "W"},
    {"%", {}, "1", false},
    {"ppm", {}, "1", false},
};

struct Spelling {
  std::string_view written;
  std::string_view si;
  std::string_view device = si;
};

constexpr Spelling other_spellings[] = {{"degree", "rad", "deg"},
                                        {"degrees", "rad", "deg"},
                                        {"\xC2\xB0", "rad", "deg"},
                                        {"celsius", "K", "degC"},
                                        {"\xC2\xB0"
                                         "C",
                                         "K", "degC"},
                                        {"inch", "m", "in"},
                                        {"meter", "m"},
                                        {"metre", "m"},
                                        {"second", "s"},
                                        {"seconds", "s"},
                                        {"sec", "s"},
                                        {"percent", "1", "%"},
                                        {"", "1"},
                                        {"none", "1"},
                                        {"-", "1"},
                                        {"Nm", "N*m"},
                                        {"ohm", "Ohm"},
                                        {"radian", "rad"},
                                        {"radians", "rad"},
                                        {"pixel", "px"},
                                        {"pixels", "px"},
                                        {"byte", "B"},
                                        {"bytes", "B"}};

struct Quantity {
  std::string_view name;
  std::array<std::string_view, 5> units;  // of each dimension that it may have; empty: no more
};

// "speed" is left out: as often it is a part of the greatest speed, a drive's override, as a velocity.
constexpr Quantity quantities[] = {{"position", {"m", "rad", "px", "B"}},
                                   {"distance", {"m", "rad", "px", "B"}},
                                   {"length", {"m", "px", "B"}},
                                   {"height", {"m", "px"}},
                                   {"depth", {"m", "px", "B"}},
                                   {"radius", {"m", "px"}},
                                   {"diameter", {"m", "px"}},
                                   {"angle", {"rad"}},
                                   {"velocity", {"m/s", "rad/s", "px/s"}},
                                   {"velocities", {"m/s", "rad/s", "px/s"}},
                                   {"acceleration", {"m/s^2", "rad/s^2", "px/s^2"}},
                                   {"deceleration", {"m/s^2", "rad/s^2", "px/s^2"}},
                                   {"jerk", {"m/s^3", "rad/s^3", "px/s^3"}},
                                   {"force", {"N"}},
                                   {"torque", {"N*m"}},
                                   {"mass", {"kg"}},
                                   {"inertia", {"kg*m^2", "kg"}},
                                   {"pressure", {"Pa"}},
                                   {"temperature", {"K"}},
                                   {"voltage", {"V"}},
                                   {"current", {"A"}},
                                   {"power", {"W", "dB"}},
                                   {"energy", {"J"}},
                                   {"frequency", {"Hz", "rad/s", "1/m", "1/px"}},
                                   {"time", {"s"}},
                                   {"duration", {"s"}},
                                   {"delay", {"s"}},
                                   {"timeout", {"s"}},
                                   {"period", {"s", "m", "px"}}};

struct Symbol {
  const UnitOfMeasure* unit = nullptr;  // null: none is known
  bool is_multiple = false;
};

Symbol find_symbol(std::string_view symbol) {
  const auto find = [](std::string_view name) {
    const auto* const found = std::find_if(std::begin(known_units), std::end(known_units),
                                           [name](const UnitOfMeasure& unit) { return unit.symbol == name; });
    return found == std::end(known_units) ? nullptr : found;
  };
  if (const UnitOfMeasure* const unit = find(symbol); unit != nullptr) return {unit, false};
  constexpr std::string_view prefixes = "pnumcdhkMG";
  if (symbol.size() < 2 || prefixes.find(symbol.front()) == std::string_view::npos) return {};
  const UnitOfMeasure* const unit = find(symbol.substr(1));
  if (unit == nullptr || !unit->has_multiples) return {};
  return {unit, true};
}

std::string judge_symbol(std::string_view name, UnitUse use) {
  const auto write = [](std::string_view unit) { return "write \"" + std::string(unit) + "\""; };
  const Symbol symbol = find_symbol(name);
  if (symbol.unit != nullptr) {
    if (use == UnitUse::device) return "";
    const std::string_view si = symbol.unit->si;
    // A device counts masses in mg as it counts lengths in mm.
    if (symbol.is_multiple && use == UnitUse::multiples && (si.empty() || symbol.unit->symbol == "g"))
      return "";
    if (symbol.is_multiple) return write(si.empty() ? symbol.unit->symbol : si) + " and give the value in it";
    return si.empty() ? "" : write(si);
  }
  for (const Spelling& spelling : other_spellings)
    if (spelling.written == name) return write(use == UnitUse::device ? spelling.device : spelling.si);
  if (use == UnitUse::device)
    return "units of measure are SI, as \"m/s\" and \"kPa\", or what devices are read in, as \"bar\", "
           "\"degC\", "
           "\"rpm\" and \"%\"; leave the cell empty for a number without";
  return "units of measure are SI, as \"m\", \"rad/s\", \"N*m\", \"m/s^2\"; \"1\" for a number without";
}

// One symbol with its exponent, and whether it stands below the line.
struct Factor {
  std::string_view symbol;
  int exponent = 1;  // 0: what stands there is none
  bool divides = false;
};

// Calls `take` with each factor of a unit without '|', until it returns false.
template <typename Take>
void each_factor(std::string_view unit, Take take) {
  bool divides = false;
  for (std::size_t start = 0;;) {
    const std::size_t end = std::min(unit.find_first_of("*/", start), unit.size());
    Factor factor{unit.substr(start, end - start), 1, divides};
    if (const std::size_t power = factor.symbol.find('^'); power != std::string_view::npos) {
      const std::string_view digits = factor.symbol.substr(power + 1);
      const auto [stop, failed] =
          std::from_chars(digits.data(), digits.data() + digits.size(), factor.exponent);
      if (failed != std::errc{} || stop != digits.data() + digits.size()) factor.exponent = 0;
      factor.symbol = factor.symbol.substr(0, power);
    }
    if (!take(factor) || end == unit.size()) return;
    divides = unit[end] == '/';
    start = end + 1;
  }
}

Dimension dimension_of(std::string_view unit) {
  Dimension sum{};
  each_factor(unit, [&sum](const Factor& factor) {
    const Symbol symbol = find_symbol(factor.symbol);
    for (std::size_t i = 0; symbol.unit != nullptr && i < sum.size(); ++i)
      sum[i] += (factor.divides ? -factor.exponent : factor.exponent) * symbol.unit->dimension[i];
    return true;
  });
  return sum;
}

// The quantity that the last word of a name stands for, in singular or plural; null: none is known.
const Quantity* quantity_of(std::string_view name) {
  const std::string_view word = name.substr(name.rfind('_') + 1);
  const auto* const found =
      std::find_if(std::begin(quantities), std::end(quantities), [word](const Quantity& quantity) {
        return word == quantity.name || (word.size() == quantity.name.size() + 1 && word.back() == 's' &&
                                         word.starts_with(quantity.name));
      });
  return found == std::end(quantities) ? nullptr : found;
}

}  // namespace

std::string judge_unit(std::string_view unit, UnitUse use) {
  if (const std::size_t other = unit.find('|'); other != std::string_view::npos) {
    const std::string advice = judge_unit(unit.substr(0, other), use);
    return advice.empty() ? judge_unit(unit.substr(other + 1), use) : advice;
  }
  std::string advice;
  each_factor(unit, [&](const Factor& factor) {
    advice = factor.exponent == 0 ? "an exponent is a whole number, as in \"m/s^2\""
                                  : judge_symbol(factor.symbol, use);
    return advice.empty();
  });
  return advice;
}

std::string replace_symbol(std::string_view unit, std::string_view symbol, std::string_view by) {
  std::string text;
  for (std::size_t start = 0; start <= unit.size();) {
    const std::size_t end = std::min(unit.find_first_of("*/^", start), unit.size());
    const std::string_view factor = unit.substr(start, end - start);
    text += factor == symbol ? by : factor;
    if (end < unit.size()) text += unit[end];
    start = end + 1;
  }
  return text;
}

bool names_quantity(std::string_view name) {
  return quantity_of(name) != nullptr;
}

std::string units_instead(std::string_view name, std::string_view unit) {
  const Quantity* const quantity = quantity_of(name);
  const std::string_view before = name.substr(0, std::min(name.rfind('_'), name.size()));
  if (quantity == nullptr || before == "per" || before.ends_with("_per")) return "";
  if (const std::size_t other = unit.find('|'); other != std::string_view::npos) {
    std::string instead = units_instead(name, unit.substr(0, other));
    return instead.empty() ? units_instead(name, unit.substr(other + 1)) : instead;
  }
  const Dimension dimension = dimension_of(unit);
  std::string listed;
  for (const std::string_view one : quantity->units) {
    if (one.empty()) break;
    if (dimension_of(one) == dimension) return "";
    listed += (listed.empty() ? "\"" : " or \"") + std::string(one) + "\"";
  }
  return listed;
}

}  // namespace flexrf::config_gen
