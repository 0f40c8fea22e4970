// Logging from any thread, real-time ones included: the caller fills a fixed record, another thread formats
// it.
#pragma once

#include <atomic>
#include <concepts>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>

#include "base/time.hpp"
#include "runtime/log/log_record.hpp"

namespace flexrf {

/// Says a message: `log_warning("jog", "target refused: {}", reason)`. Any thread; wait-free, no allocation,
/// no system call but reading the clock (not even that in a thread with set_log_clock). `source` and `format`
/// must live for ever (string literals, names from the application's tables). Up to 6 arguments: integers,
/// floating point, bool, text (copied, at most 256 bytes of all texts together, cut beyond), StaticText (not
/// copied). Placeholders: `{}`, `{:x}` for hexadecimal, `{:.3}` for digits after the decimal point; checked
/// when compiling. A full ring drops the message and counts it.
template <class... Arguments>
void log_debug(const char* source, LogFormat<Arguments...> format, const Arguments&... arguments) noexcept;
template <class... Arguments>
void log_info(const char* source, LogFormat<Arguments...> format, const Arguments&... arguments) noexcept;
template <class... Arguments>
void log_warning(const char* source, LogFormat<Arguments...> format, const Arguments&... arguments) noexcept;
template <class... Arguments>
void log_error(const char* source, LogFormat<Arguments...> format, const Arguments&... arguments) noexcept;

/// The same, at most once a second: what was held back in between is counted and said with the next.
template <class... Arguments>
void log_warning(LogLimit& limit, const char* source, LogFormat<Arguments...> format,
                 const Arguments&... arguments) noexcept;
template <class... Arguments>
void log_error(LogLimit& limit, const char* source, LogFormat<Arguments...> format,
               const Arguments&... arguments) noexcept;

/// Less severe messages are not even recorded. Any thread; info at first.
void set_log_threshold(Severity severity) noexcept;
/// This thread's messages carry *now instead of the clock's time (the step's time; simulated time); null: the
/// clock's.
void set_log_clock(const Time* now) noexcept;
/// The time that lines count from (the application's start). Non-real-time threads; 0 at first.
void set_log_origin(Time origin) noexcept;

/// Formats what was recorded and writes it to `descriptor` (−1: nowhere), a line `[  12.345678] warning jog:
/// …` each; at most one ring's worth per call. Waits for whoever reads there: for a thread that nothing else
/// waits for. Non-real-time threads.
/// @returns number of lines.
std::size_t drain_log(int descriptor) noexcept;

/// For a thread that must not wait: where another one's drain_log() has been waiting for its reader for
/// longer than `patience`, takes over what was recorded, so that the panel shows it and the ring does not
/// fill. These lines are not written; drain_log() says how many when it goes on. Non-real-time threads.
/// @returns number of lines.
std::size_t relieve_log(Duration patience) noexcept;

/// Lines that were not written because nobody took them, or because writing failed. Any thread.
std::uint64_t unwritten_log_lines() noexcept;

/// Why the last line that could not be written was not, errno's value; 0: there was none. Any thread.
int log_write_error() noexcept;

/// The last lines that were drained, for the panel. Calls `line(context, number, text)` for each line whose
/// number is greater than `after`, oldest first; numbers count from 1. Non-real-time threads; must not drain
/// or log_... from inside.
/// @returns the number of the last line so far.
std::uint64_t visit_recent_log(std::uint64_t after, void* context,
                               void (*line)(void* context, std::uint64_t number,
                                            std::string_view text)) noexcept;

/// What was logged as a warning or an error since the start: how often, and the first of them, which are the
/// causes of most that follow.
struct LoggedWarnings {
  static constexpr std::size_t kept = 3;
  std::uint64_t count = 0;
  std::string first[kept];  ///< lines, oldest first
};
/// Non-real-time threads.
LoggedWarnings logged_warnings();

/// Messages dropped since the start because the ring was full. Any thread.
std::uint64_t dropped_log_messages() noexcept;

}  // namespace flexrf

#include "runtime/log/log_inline.hpp"
