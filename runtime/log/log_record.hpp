// What one log message is until it is formatted: pointers to literals, values, copied text.
#pragma once

#include <atomic>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <type_traits>

#include "base/time.hpp"

namespace flexrf {

enum class Severity : std::uint8_t { debug, info, warning, error };
const char* name_of(Severity severity) noexcept;

/// Text that lives for ever: its pointer is recorded, not its characters.
struct StaticText {
  const char* text;
};

inline constexpr std::size_t log_arguments = 6;
inline constexpr std::size_t log_text_bytes = 256;

/// Counts and checks the placeholders of a format while compiling.
consteval int count_log_placeholders(std::string_view format) {
  int count = 0;
  for (std::size_t i = 0; i < format.size(); ++i) {
    if (format[i] != '{') continue;
    const std::size_t end = format.find('}', i);
    if (end == std::string_view::npos) return -1;
    const std::string_view spec = format.substr(i + 1, end - i - 1);
    const bool known = spec.empty() || spec == ":x" ||
                       (spec.size() == 3 && spec.starts_with(":.") && spec[2] >= '0' && spec[2] <= '9');
    if (!known) return -1;
    ++count;
    i = end;
  }
  return count;
}

/// A format literal whose placeholders match the number of arguments; anything else does not compile.
template <class... Arguments>
struct BasicLogFormat {
  template <std::size_t N>
  consteval BasicLogFormat(const char (&literal)[N]) : text(literal) {
    static_assert(sizeof...(Arguments) <= log_arguments, "a log message takes at most 6 arguments");
    if (count_log_placeholders(std::string_view(literal, N - 1)) != static_cast<int>(sizeof...(Arguments)))
      throw "the format's placeholders do not match the arguments";
  }
  const char* text;
};
template <class... Arguments>
using LogFormat = BasicLogFormat<std::type_identity_t<Arguments>...>;

/// One message as its thread recorded it.
struct LogRecord {
  enum class Kind : std::uint8_t { none, signed_integer, unsigned_integer, real, boolean, static_text, text };
  union Value {
    std::int64_t signed_integer;
    std::uint64_t unsigned_integer;
    double real;
    const char* static_text;
    struct {
      std::uint16_t offset;  ///< into `text`
      std::uint16_t size;
    } text;
  };

  std::uint64_t ticket;  ///< place in the ring's order
  Time time;
  const char* source;
  const char* format;
  Severity severity;
  Kind kinds[log_arguments];
  std::uint16_t text_used;
  std::uint32_t held_back;  ///< equal messages that a LogLimit held back before this one
  Value values[log_arguments];
  char text[log_text_bytes];

  /// Records the next argument as the `index`-th.
  template <class Argument>
  void set(std::size_t index, const Argument& argument) noexcept {
    if constexpr (std::same_as<Argument, bool>) {
      kinds[index] = Kind::boolean;
      values[index].unsigned_integer = argument ? 1 : 0;
    } else if constexpr (std::is_enum_v<Argument>) {
      set(index, static_cast<std::underlying_type_t<Argument>>(argument));
    } else if constexpr (std::signed_integral<Argument>) {
      kinds[index] = Kind::signed_integer;
      values[index].signed_integer = argument;
    } else if constexpr (std::unsigned_integral<Argument>) {
      kinds[index] = Kind::unsigned_integer;
      values[index].unsigned_integer = argument;
    } else if constexpr (std::floating_point<Argument>) {
      kinds[index] = Kind::real;
      values[index].real = static_cast<double>(argument);
    } else if constexpr (std::same_as<Argument, StaticText>) {
      kinds[index] = Kind::static_text;
      values[index].static_text = argument.text;
    } else if constexpr (std::convertible_to<const Argument&, const char*>) {
      const char* const text_argument = argument;
      set_text(index,
               text_argument == nullptr ? std::string_view("(null)") : std::string_view(text_argument));
    } else {
      set_text(index, std::string_view(argument));
    }
  }

 private:
  void set_text(std::size_t index, std::string_view argument) noexcept;
};

/// Formats a record into `line` (without a newline, cut at capacity − 1, zero-terminated).
/// @returns characters written.
std::size_t format_log_record(const LogRecord& record, Time origin, char* line,
                              std::size_t capacity) noexcept;

/// Lets one message of a kind through per second and counts the others. One per message, a member or static.
/// Any thread, wait-free.
class LogLimit {
 public:
  constexpr LogLimit() noexcept = default;
  /// True when a message may be said at `now`; `held_back` then counts those since the last that was.
  bool admit(Time now, std::uint32_t& held_back) noexcept;
  /// Messages held back since one was said last.
  std::uint32_t held_back() const noexcept { return held_back_.load(std::memory_order_relaxed); }

 private:
  std::atomic<std::int64_t> next_{INT64_MIN};  ///< ns; earlier ones are held back
  std::atomic<std::uint32_t> held_back_{0};
};

}  // namespace flexrf
