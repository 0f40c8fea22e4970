#include "runtime/log/log.hpp"

#include <unistd.h>

#include <cinttypes>
#include <cstdio>
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

  char* next() noexcept { return text[lines % recent_lines]; }
  void keep(std::size_t length, int descriptor) noexcept {
    char* const line = next();
    size[lines % recent_lines] = static_cast<std::uint16_t>(length);
    ++lines;
    if (descriptor < 0) return;
    // One write per line, so that lines of several processes do not mix; nobody can be told when it fails.
    line[length] = '\n';
    [[maybe_unused]] const ssize_t written = write(descriptor, line, length + 1);
    line[length] = '\0';
  }
};
constinit Drained drained;

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
  const std::lock_guard lock(drained.mutex);
  const Time zero{Duration{origin.load(std::memory_order_relaxed)}};
  const std::uint64_t before = drained.lines;
  for (std::uint32_t i = 0; i < LogRing::capacity; ++i) {
    const LogRecord* const record = ring.front();
    if (record == nullptr) break;
    // One character is left for the newline.
    const std::size_t length = format_log_record(*record, zero, drained.next(), line_capacity - 1);
    ring.pop();
    drained.keep(length, descriptor);
  }
  const std::uint64_t dropped = ring.dropped();
  if (dropped != drained.drops_said) {
    LogRecord record{};
    record.time = log_time();
    record.source = "log";
    record.format = "{} messages dropped, the ring was full";
    record.severity = Severity::warning;
    record.set(0, dropped - drained.drops_said);
    drained.drops_said = dropped;
    drained.keep(format_log_record(record, zero, drained.next(), line_capacity - 1), descriptor);
  }
  return drained.lines - before;
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
