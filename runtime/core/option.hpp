// Options of the command line: who reads one declares it (the executive, the panel, a driver's table).
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string_view>

#include "base/status.hpp"
#include "base/time.hpp"

namespace flexrf {

/// What the value is. What it has to be is checked before anything is started.
enum class OptionKind : std::uint8_t {
  flag,         ///< there is none
  text,         ///< anything but nothing
  number,       ///< finite, from `least` to `most`
  duration,     ///< above 0, with its unit, one word: "60s", "500ms"
  file,         ///< to be read: a regular file that is there
  output_file,  ///< to be written: it need not be there, its folder must
  kept_file,    ///< likewise, and it is read, too
  folder,       ///< is there
};

struct Option {
  const char* name;  ///< "--keys"
  OptionKind kind;
  const char* value;  ///< how --help calls what follows: "FILE"; null: nothing, of a flag
  const char* summary;
  const char* unit = "";  ///< of measure, of a number
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
  bool chooses = false;  ///< of a driver: when it is given, devices that permit this driver have it
};

/// ok, or invalid_argument: what a number or a duration has to be. Files are not looked at.
Status check_value(const Option& option, const char* value) noexcept;

struct GivenOption {
  const Option* option;
  const char* value;  ///< null: of a flag
};

/// What the command line gives; where it gives an option twice, the last. A view. Any thread.
class OptionValues {
 public:
  constexpr OptionValues() noexcept = default;
  explicit constexpr OptionValues(std::span<const GivenOption> given) noexcept : given_(given) {}

  bool has(std::string_view name) const noexcept { return find(name) != nullptr; }
  /// A text, or the path of a file or a folder; `otherwise` when it is not given.
  const char* text(std::string_view name, const char* otherwise = nullptr) const noexcept;
  /// In the option's unit.
  std::optional<double> number(std::string_view name) const noexcept;
  std::optional<Duration> duration(std::string_view name) const noexcept;

 private:
  const GivenOption* find(std::string_view name) const noexcept;

  std::span<const GivenOption> given_;
};

}  // namespace flexrf
