#include "runtime/log/log_record.hpp"

#include <algorithm>
#include <cinttypes>
#include <cstdarg>
#include <cstdio>
#include <cstring>

namespace flexrf {

namespace {

/// Appends to a text of fixed capacity; what does not fit is cut.
class Line {
 public:
  Line(char* text, std::size_t capacity) noexcept : text_(text), capacity_(capacity) { text_[0] = '\0'; }

  void append(std::string_view part) noexcept {
    const std::size_t room = capacity_ - 1 - size_;
    const std::size_t size = std::min(part.size(), room);
    for (std::size_t i = 0; i < size; ++i) {
      // A message is one line and leaves the terminal's state alone, whatever its texts contain.
      const auto character = static_cast<unsigned char>(part[i]);
      text_[size_ + i] = character < 0x20 || character == 0x7F ? ' ' : part[i];
    }
    size_ += size;
    text_[size_] = '\0';
  }
  [[gnu::format(printf, 2, 3)]] void print(const char* format, ...) noexcept {
    va_list arguments;
    va_start(arguments, format);
    const int wanted = std::vsnprintf(text_ + size_, capacity_ - size_, format, arguments);
    va_end(arguments);
    if (wanted > 0) size_ = std::min(size_ + static_cast<std::size_t>(wanted), capacity_ - 1);
  }
  std::size_t size() const noexcept { return size_; }

 private:
  char* text_;
  std::size_t capacity_;
  std::size_t size_ = 0;
};

void append_argument(Line& line, const LogRecord& record, std::size_t index, std::string_view spec) noexcept {
  const LogRecord::Value& value = record.values[index];
  const bool hexadecimal = spec == ":x";
  switch (record.kinds[index]) {
    case LogRecord::Kind::none:
      break;
    case LogRecord::Kind::signed_integer:
      if (hexadecimal)
        line.print("%" PRIx64, value.unsigned_integer);
      else
        line.print("%" PRId64, value.signed_integer);
      break;
    case LogRecord::Kind::unsigned_integer:
      if (hexadecimal)
        line.print("%" PRIx64, value.unsigned_integer);
      else
        line.print("%" PRIu64, value.unsigned_integer);
      break;
    case LogRecord::Kind::real:
      if (spec.starts_with(":."))
        line.print("%.*f", spec[2] - '0', value.real);
      else
        line.print("%.6g", value.real);
      break;
    case LogRecord::Kind::boolean:
      line.append(value.unsigned_integer != 0 ? "true" : "false");
      break;
    case LogRecord::Kind::static_text:
      line.append(value.static_text == nullptr ? "(null)" : value.static_text);
      break;
    case LogRecord::Kind::text:
      line.append(std::string_view(record.text + value.text.offset, value.text.size));
      break;
  }
}

}  // namespace

const char* name_of(Severity severity) noexcept {
  switch (severity) {
    case Severity::debug:
      return "debug";
    case Severity::info:
      return "info";
    case Severity::warning:
      return "warning";
    case Severity::error:
      return "error";
  }
  return "unknown";
}

void LogRecord::set_text(std::size_t index, std::string_view argument) noexcept {
  const std::size_t size = std::min(argument.size(), log_text_bytes - text_used);
  std::memcpy(text + text_used, argument.data(), size);
  kinds[index] = Kind::text;
  values[index].text.offset = text_used;
  values[index].text.size = static_cast<std::uint16_t>(size);
  text_used = static_cast<std::uint16_t>(text_used + size);
}

std::size_t format_log_record(const LogRecord& record, Time origin, char* text,
                              std::size_t capacity) noexcept {
  Line line(text, capacity);
  const std::int64_t elapsed = (record.time - origin).count() / 1000;
  const std::int64_t magnitude = elapsed < 0 ? -elapsed : elapsed;
  char whole[24];
  std::snprintf(whole, sizeof(whole), "%s%" PRId64, elapsed < 0 ? "-" : "", magnitude / 1'000'000);
  line.print("[%4s.%06d] %s %s: ", whole, static_cast<int>(magnitude % 1'000'000), name_of(record.severity),
             record.source);
  const std::string_view format = record.format;
  std::size_t argument = 0;
  std::size_t begin = 0;
  while (begin < format.size()) {
    const std::size_t open = std::min(format.find('{', begin), format.size());
    line.append(format.substr(begin, open - begin));
    if (open == format.size()) break;
    const std::size_t close = format.find('}', open);
    if (close == std::string_view::npos || argument == log_arguments) break;
    append_argument(line, record, argument++, format.substr(open + 1, close - open - 1));
    begin = close + 1;
  }
  if (record.held_back > 0) line.print(" (%" PRIu32 " more since)", record.held_back);
  return line.size();
}

bool LogLimit::admit(Time now, std::uint32_t& held_back) noexcept {
  constexpr std::int64_t interval = 1'000'000'000;
  std::int64_t next = next_.load(std::memory_order_relaxed);
  if (nanoseconds(now) < next ||
      !next_.compare_exchange_strong(next, nanoseconds(now) + interval, std::memory_order_relaxed)) {
    held_back_.fetch_add(1, std::memory_order_relaxed);
    return false;
  }
  held_back = held_back_.exchange(0, std::memory_order_relaxed);
  return true;
}

}  // namespace flexrf
