#include "config-gen/read/quantities.hpp"

#include <algorithm>
#include <charconv>
#include <iterator>

namespace flexrf::config_gen {
namespace {

constexpr std::string_view coherent[] = {"m",  "kg", "s",  "A",  "K",  "mol", "cd",  "rad", "sr",  "Hz", "N",
                                         "Pa", "J",  "W",  "C",  "V",  "F",   "Ohm", "S",   "Wb",  "T",  "H",
                                         "lm", "lx", "Bq", "Gy", "Sv", "kat", "px",  "B",   "bit", "dB"};

struct Instead {
  std::string_view unit;
  std::string_view write;
};

constexpr Instead not_si[] = {{"deg", "rad"},   {"degree", "rad"}, {"degrees", "rad"}, {"degC", "K"},
                              {"celsius", "K"}, {"rpm", "rad/s"},  {"min", "s"},       {"h", "s"},
                              {"bar", "Pa"},    {"inch", "m"},     {"in", "m"},        {"meter", "m"},
                              {"metre", "m"},   {"second", "s"},   {"seconds", "s"},   {"sec", "s"},
                              {"g", "kg"},      {"l", "m^3"},      {"%", "1"},         {"percent", "1"},
                              {"", "1"},        {"none", "1"},     {"-", "1"},         {"Nm", "N*m"},
                              {"psi", "Pa"},    {"ohm", "Ohm"},    {"radian", "rad"},  {"radians", "rad"},
                              {"pixel", "px"},  {"pixels", "px"},  {"byte", "B"},      {"bytes", "B"}};

// "speed" is left out: as often it is a part of the greatest speed, a drive's override, as a velocity.
constexpr std::string_view quantities[] = {
    "position", "distance",   "length",       "height",       "depth",   "radius", "diameter", "angle",
    "velocity", "velocities", "acceleration", "deceleration", "jerk",    "force",  "torque",   "mass",
    "inertia",  "pressure",   "temperature",  "voltage",      "current", "power",  "energy",   "frequency",
    "time",     "duration",   "delay",        "timeout",      "period"};

bool is_coherent(std::string_view symbol) {
  return std::find(std::begin(coherent), std::end(coherent), symbol) != std::end(coherent);
}

std::string judge_symbol(std::string_view symbol, bool multiples) {
  if (symbol == "1" || is_coherent(symbol)) return "";
  for (const Instead& row : not_si)
    if (row.unit == symbol) return "write \"" + std::string(row.write) + "\"";
  constexpr std::string_view prefixes = "pnumcdhkMG";
  if (symbol.size() > 1 && prefixes.find(symbol.front()) != std::string_view::npos &&
      (is_coherent(symbol.substr(1)) || symbol.substr(1) == "g"))
    return multiples ? ""
                     : "write \"" + std::string(symbol.substr(1) == "g" ? "kg" : symbol.substr(1)) +
                           "\" and give the value in it";
  return "units of measure are SI, as \"m\", \"rad/s\", \"N*m\", \"m/s^2\"; \"1\" for a number without";
}

}  // namespace

std::string judge_unit(std::string_view unit, bool multiples) {
  if (const std::size_t other = unit.find('|'); other != std::string_view::npos) {
    const std::string advice = judge_unit(unit.substr(0, other), multiples);
    return advice.empty() ? judge_unit(unit.substr(other + 1), multiples) : advice;
  }
  std::size_t start = 0;
  while (true) {
    const std::size_t end = std::min(unit.find_first_of("*/", start), unit.size());
    std::string_view factor = unit.substr(start, end - start);
    if (const std::size_t power = factor.find('^'); power != std::string_view::npos) {
      std::string_view exponent = factor.substr(power + 1);
      int value = 0;
      const auto [stop, failed] = std::from_chars(exponent.data(), exponent.data() + exponent.size(), value);
      if (failed != std::errc{} || stop != exponent.data() + exponent.size() || value == 0)
        return "an exponent is a whole number, as in \"m/s^2\"";
      factor = factor.substr(0, power);
    }
    if (std::string advice = judge_symbol(factor, multiples); !advice.empty()) return advice;
    if (end == unit.size()) return "";
    start = end + 1;
  }
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
  const std::string_view word = name.substr(name.rfind('_') + 1);
  return std::any_of(std::begin(quantities), std::end(quantities), [word](std::string_view quantity) {
    return word == quantity ||
           (word.size() == quantity.size() + 1 && word.back() == 's' && word.starts_with(quantity));
  });
}

}  // namespace flexrf::config_gen
