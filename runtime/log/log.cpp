#include "runtime/log/log.hpp"

#include <unistd.h>

#include <cinttypes>
#include <cstdio>
#include <cstring>
#include <mutex>

namespace flexrf {

namespace {

constexpr std::size_t line_capacity = 400;
constexpr std::size_t recent_lines = 200;

constinit LogRing ring;
constinit std::atomic<Severity> threshold{Severity::info};
constinit std::atomic<std::int64_t> origin{0};
constinit thread_local const Time* thread_clock [[gnu::tls_model("initial-exec")]] = nullptr;

/// What was drained. The mutex is between threads that are not real-time: those that drain and those that
/// look.
struct Drained {
  std::mutex mutex;
  std::uint64_t lines = 0;
  std::uint64_t drops_said = 0;
  char text[recent_lines][line_capacity]{};
  std::uint16_t size[recent_lines]{};

  void keep(const char* line, std::size_t length) noexcept {
    std::memcpy(text[lines % recent_lines], line, length);
    size[lines % recent_lines] = static_cast<std::uint16_t>(length);
    ++lines;
  }
  /// Formats what was recorded next and keeps it; its length, or 0 when there is nothing.
  std::size_t take(char* line) noexcept;
};
constinit Drained drained;

std::size_t Drained::take(char* line) noexcept {
  const Time zero{Duration{origin.load(std::memory_order_relaxed)}};
  std::size_t length = 0;
  if (const LogRecord* const record = ring.front(); record != nullptr) {
    // One character is left for the newline.
    length = format_log_record(*record, zero, line, line_capacity - 1);
    ring.pop();
  } else if (const std::uint64_t dropped = ring.dropped(); dropped != drops_said) {
    LogRecord said{};
    said.time = log_time();
    said.source = "log";
    said.format = "{} messages dropped, the ring was full";
    said.severity = Severity::warning;
    said.set(0, dropped - drops_said);
    drops_said = dropped;
    length = format_log_record(said, zero, line, line_capacity - 1);
  }
  if (length != 0) keep(line, length);
  return length;
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
  for (; lines <= LogRing::capacity; ++lines) {
    std::size_t length = 0;
    {
      const std::lock_guard lock(drained.mutex);
      length = drained.take(line);
    }
    if (length == 0) break;
    if (descriptor < 0) continue;
    // One write per line, so that lines of several processes do not mix; nobody can be told when it fails.
    // Without the lock: whoever looks at the recent lines does not wait for a terminal that takes nothing.
    line[length] = '\n';
    [[maybe_unused]] const ssize_t written = write(descriptor, line, length + 1);
  }
  return lines;
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

std::uint64_t dropped_log_messages() noexcept {
  return ring.dropped();
}

}  // namespace flexrf
