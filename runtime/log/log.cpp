#include "runtime/log/log.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <mutex>

namespace flexrf {

namespace {

constexpr std::size_t line_capacity = 400;
constexpr std::size_t recent_lines = 200;

constinit LogRing ring;
constinit std::atomic<Severity> threshold{Severity::info};
constinit std::atomic<std::int64_t> origin{0};
/// Since when a line is being written, ns of the monotonic clock; 0: none is.
constinit std::atomic<std::int64_t> writing_since{0};
constinit std::atomic<std::uint64_t> unwritten{0};
constinit std::atomic<int> write_error{0};
constinit std::atomic<bool> is_line_torn{false};
constinit thread_local const Time* thread_clock [[gnu::tls_model("initial-exec")]] = nullptr;

/// What was drained. The mutex is between threads that are not real-time: those that drain and those that
/// look.
struct Drained {
  std::mutex mutex;
  std::uint64_t lines = 0;
  std::uint64_t drops_said = 0;
  std::uint64_t unwritten_said = 0;
  char text[recent_lines][line_capacity]{};
  std::uint16_t size[recent_lines]{};
  std::uint64_t warnings = 0;
  char first_warnings[LoggedWarnings::kept][line_capacity]{};  // each ends with a zero

  void keep_warning(const char* line, std::size_t length) noexcept {
    if (warnings < LoggedWarnings::kept) {
      std::memcpy(first_warnings[warnings], line, length);
      first_warnings[warnings][length] = '\0';
    }
    ++warnings;
  }
  void keep(const char* line, std::size_t length) noexcept {
    std::memcpy(text[lines % recent_lines], line, length);
    size[lines % recent_lines] = static_cast<std::uint16_t>(length);
    ++lines;
  }
  /// Formats what was recorded next and keeps it; its length, or 0 when there is nothing. `is_written`: the
  /// line before was, so that it is the time to say what was not.
  std::size_t take(char* line, bool is_written) noexcept;
};
constinit Drained drained;

/// A line that the log says of itself.
LogRecord remark(const char* format, std::uint64_t count) noexcept {
  LogRecord said{};
  said.time = log_time();
  said.source = "log";
  said.format = format;
  said.severity = Severity::warning;
  said.set(0, count);
  return said;
}

std::size_t Drained::take(char* line, bool is_written) noexcept {
  const Time zero{Duration{origin.load(std::memory_order_relaxed)}};
  // One character is left for the newline.
  const auto format = [&](const LogRecord& record) {
    return format_log_record(record, zero, line, line_capacity - 1);
  };
  std::size_t length = 0;
  if (const std::uint64_t lost = unwritten.load(std::memory_order_relaxed);
      is_written && lost != unwritten_said) {
    length = format(remark("{} lines were not written here: nobody read them in time, or writing failed",
                           lost - unwritten_said));
    unwritten_said = lost;
  } else if (const LogRecord* const record = ring.front(); record != nullptr) {
    length = format(*record);
    if (record->severity >= Severity::warning) keep_warning(line, length);
    ring.pop();
  } else if (const std::uint64_t dropped = ring.dropped(); dropped != drops_said) {
    length = format(remark("{} messages dropped, the ring was full", dropped - drops_said));
    drops_said = dropped;
  }
  if (length != 0) keep(line, length);
  return length;
}

/// One line, kept as the newest; its length, 0 when there is none.
std::size_t take_line(char* line, bool is_written) noexcept {
  const std::lock_guard lock(drained.mutex);
  return drained.take(line, is_written);
}

/// Of a full disk a part may be written: what follows then begins on a line of its own.
bool write_all(int descriptor, const char* text, std::size_t size) noexcept {
  for (std::size_t done = 0; done < size;) {
    const ssize_t written = write(descriptor, text + done, size - done);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) {
      write_error.store(errno, std::memory_order_relaxed);
      if (done > 0) is_line_torn.store(true, std::memory_order_relaxed);
      return false;
    }
    done += static_cast<std::size_t>(written);
  }
  return true;
}

/// All of it, or false.
bool write_line(int descriptor, const char* line, std::size_t size) noexcept {
  writing_since.store(nanoseconds(MonotonicClock::now()), std::memory_order_relaxed);
  bool is_written = true;
  if (is_line_torn.load(std::memory_order_relaxed)) {
    is_written = write_all(descriptor, "\n", 1);
    if (is_written) is_line_torn.store(false, std::memory_order_relaxed);
  }
  is_written = is_written && write_all(descriptor, line, size);
  writing_since.store(0, std::memory_order_relaxed);
  return is_written;
}

}  // namespace

LogRing& process_log_ring() noexcept {
  return ring;
}

bool is_logged(Severity severity) noexcept {
  return severity >= threshold.load(std::memory_order_relaxed);
}

Time log_time() noexcept {
  return thread_clock != nullptr ? *thread_clock : MonotonicClock::now();
}

void set_log_threshold(Severity severity) noexcept {
  threshold.store(severity, std::memory_order_relaxed);
}

void set_log_clock(const Time* now) noexcept {
  thread_clock = now;
}

void set_log_origin(Time time) noexcept {
  origin.store(nanoseconds(time), std::memory_order_relaxed);
}

std::size_t drain_log(int descriptor) noexcept {
  char line[line_capacity];
  std::size_t lines = 0;
  bool is_written = false;
  for (; lines <= LogRing::capacity; ++lines) {
    const std::size_t length = take_line(line, is_written);
    if (length == 0) break;
    if (descriptor < 0) continue;
    // One write per line, so that lines of several processes do not mix. Without the lock: whoever looks at
    // the recent lines does not wait for a terminal that takes nothing.
    line[length] = '\n';
    is_written = write_line(descriptor, line, length + 1);
    if (!is_written) unwritten.fetch_add(1, std::memory_order_relaxed);
  }
  return lines;
}

std::size_t relieve_log(Duration patience) noexcept {
  const std::int64_t since = writing_since.load(std::memory_order_relaxed);
  if (since == 0 || nanoseconds(MonotonicClock::now()) - since < patience.count()) return 0;
  char line[line_capacity];
  std::size_t lines = 0;
  while (lines <= LogRing::capacity && take_line(line, false) != 0) ++lines;
  unwritten.fetch_add(lines, std::memory_order_relaxed);
  return lines;
}

std::uint64_t unwritten_log_lines() noexcept {
  return unwritten.load(std::memory_order_relaxed);
}

int log_write_error() noexcept {
  return write_error.load(std::memory_order_relaxed);
}

std::uint64_t visit_recent_log(std::uint64_t after, void* context,
                               void (*line)(void* context, std::uint64_t number,
                                            std::string_view text)) noexcept {
  const std::lock_guard lock(drained.mutex);
  const std::uint64_t oldest = drained.lines > recent_lines ? drained.lines - recent_lines : 0;
  for (std::uint64_t i = after > oldest ? after : oldest; i < drained.lines; ++i) {
    const std::size_t place = i % recent_lines;
    line(context, i + 1, std::string_view(drained.text[place], drained.size[place]));
  }
  return drained.lines;
}

LoggedWarnings logged_warnings() {
  const std::lock_guard lock(drained.mutex);
  LoggedWarnings result;
  result.count = drained.warnings;
  for (std::size_t i = 0; i < LoggedWarnings::kept && i < drained.warnings; ++i)
    result.first[i] = drained.first_warnings[i];
  return result;
}

std::uint64_t dropped_log_messages() noexcept {
  return ring.dropped();
}

}  // namespace flexrf
