// How a message gets into the ring. Included by log.hpp.
#pragma once

#include "runtime/log/log_ring.hpp"

namespace flexrf {

/// Whether a message of this severity is recorded at all.
bool is_logged(Severity severity) noexcept;
/// The time of a message said now in this thread.
Time log_time() noexcept;

template <class... Arguments>
void record_log(Severity severity, Time time, std::uint32_t held_back, const char* source, const char* format,
                const Arguments&... arguments) noexcept {
  LogRing::Cell* const cell = process_log_ring().claim(severity);
  if (cell == nullptr) return;
  LogRecord& record = cell->record;
  record.time = time;
  record.source = source;
  record.format = format;
  record.severity = severity;
  record.text_used = 0;
  record.held_back = held_back;
  for (LogRecord::Kind& kind : record.kinds) kind = LogRecord::Kind::none;
  [[maybe_unused]] std::size_t index = 0;
  (record.set(index++, arguments), ...);
  LogRing::publish(*cell);
}

template <class... Arguments>
void record_limited_log(LogLimit& limit, Severity severity, const char* source, const char* format,
                        const Arguments&... arguments) noexcept {
  if (!is_logged(severity)) return;
  const Time now = log_time();
  std::uint32_t held_back = 0;
  if (limit.admit(now, held_back)) record_log(severity, now, held_back, source, format, arguments...);
}

template <class... Arguments>
void log_debug(const char* source, LogFormat<Arguments...> format, const Arguments&... arguments) noexcept {
  if (is_logged(Severity::debug))
    record_log(Severity::debug, log_time(), 0, source, format.text, arguments...);
}
template <class... Arguments>
void log_info(const char* source, LogFormat<Arguments...> format, const Arguments&... arguments) noexcept {
  if (is_logged(Severity::info)) record_log(Severity::info, log_time(), 0, source, format.text, arguments...);
}
template <class... Arguments>
void log_warning(const char* source, LogFormat<Arguments...> format, const Arguments&... arguments) noexcept {
  if (is_logged(Severity::warning))
    record_log(Severity::warning, log_time(), 0, source, format.text, arguments...);
}
template <class... Arguments>
void log_error(const char* source, LogFormat<Arguments...> format, const Arguments&... arguments) noexcept {
  if (is_logged(Severity::error))
    record_log(Severity::error, log_time(), 0, source, format.text, arguments...);
}
template <class... Arguments>
void log_warning(LogLimit& limit, const char* source, LogFormat<Arguments...> format,
                 const Arguments&... arguments) noexcept {
  record_limited_log(limit, Severity::warning, source, format.text, arguments...);
}
template <class... Arguments>
void log_error(LogLimit& limit, const char* source, LogFormat<Arguments...> format,
               const Arguments&... arguments) noexcept {
  record_limited_log(limit, Severity::error, source, format.text, arguments...);
}

}  // namespace flexrf
