#include "runtime/log/log.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <string>
#include <thread>
#include <vector>

#include "tests/cmocka.hpp"

namespace flexrf {
namespace {

constexpr Time at(double seconds) {
  return Time{Duration{static_cast<std::int64_t>(seconds * 1e9)}};
}

struct Recent {
  char last[512];
  std::uint64_t count;
};

/// Drains to nowhere and gives the last line.
const char* last_line() {
  static Recent recent;
  recent = {};
  drain_log(-1);
  visit_recent_log(0, &recent, [](void* context, std::uint64_t, std::string_view text) {
    auto& seen = *static_cast<Recent*>(context);
    seen.last[text.copy(seen.last, sizeof(seen.last) - 1)] = '\0';
    ++seen.count;
  });
  return recent.last;
}

int start_clean(void**) {
  drain_log(-1);
  drain_log(-1);
  set_log_threshold(Severity::info);
  set_log_origin(Time{});
  return 0;
}

void formats_every_kind_of_argument(void**) {
  const Time now = at(12.345678);
  set_log_clock(&now);
  log_warning("jog", "target refused: {}", "too far");
  assert_string_equal(last_line(), "[  12.345678] warning jog: target refused: too far");
  log_info("a", "{} {} {} {} {} {}", -3, 4U, 2.5, true, StaticText{"fixed"}, std::string_view("view"));
  assert_string_equal(last_line(), "[  12.345678] info a: -3 4 2.5 true fixed view");
  log_error("a", "{:x} {:.3} {}", 255, 1.0 / 3, static_cast<const char*>(nullptr));
  assert_string_equal(last_line(), "[  12.345678] error a: ff 0.333 (null)");
  log_info("a", "bell\a {}", "two\nlines");
  assert_string_equal(last_line(), "[  12.345678] info a: bell  two lines");
  set_log_clock(nullptr);
}

void copies_text_and_cuts_what_is_too_long(void**) {
  const Time now = at(0.5);
  set_log_clock(&now);
  char text[300];
  memset(text, 'x', sizeof(text));
  text[299] = '\0';
  log_info("a", "{}|{}", text, "no room");
  memset(text, 'y', sizeof(text) - 1);
  char expected[512];
  snprintf(expected, sizeof(expected), "[   0.500000] info a: %s|", std::string(256, 'x').c_str());
  assert_string_equal(last_line(), expected);
  set_log_clock(nullptr);
}

void counts_time_from_the_origin(void**) {
  const Time now = at(100.25);
  set_log_clock(&now);
  set_log_origin(at(99));
  log_info("a", "later");
  assert_string_equal(last_line(), "[   1.250000] info a: later");
  set_log_origin(at(101));
  log_info("a", "before");
  assert_string_equal(last_line(), "[  -0.750000] info a: before");
  set_log_clock(nullptr);
}

void leaves_out_what_is_below_the_threshold(void**) {
  log_debug("a", "not said");
  assert_int_equal(drain_log(-1), 0);
  set_log_threshold(Severity::debug);
  log_debug("a", "said");
  assert_int_equal(drain_log(-1), 1);
  set_log_threshold(Severity::error);
  log_warning("a", "not said");
  assert_int_equal(drain_log(-1), 0);
}

void writes_a_line_per_message(void**) {
  int ends[2];
  assert_int_equal(pipe(ends), 0);
  const Time now = at(1);
  set_log_clock(&now);
  log_info("a", "one");
  log_info("a", "two");
  assert_int_equal(drain_log(ends[1]), 2);
  char text[128] = {};
  assert_true(read(ends[0], text, sizeof(text) - 1) > 0);
  assert_string_equal(text, "[   1.000000] info a: one\n[   1.000000] info a: two\n");
  close(ends[0]);
  close(ends[1]);
  set_log_clock(nullptr);
}

void counts_drops_and_says_so(void**) {
  const std::uint64_t before = dropped_log_messages();
  for (std::uint32_t i = 0; i < LogRing::capacity; ++i) log_info("a", "{}", i);
  // The reserve still takes errors.
  assert_int_equal(dropped_log_messages() - before, LogRing::reserve);
  for (std::uint32_t i = 0; i < LogRing::reserve; ++i) log_error("a", "{}", i);
  assert_int_equal(dropped_log_messages() - before, LogRing::reserve);
  log_error("a", "one too many");
  assert_int_equal(dropped_log_messages() - before, LogRing::reserve + 1);
  assert_non_null(strstr(last_line(), "warning log: 65 messages dropped, the ring was full"));
  assert_int_equal(drain_log(-1), 0);
  log_info("a", "goes on");
  assert_non_null(strstr(last_line(), "goes on"));
}

void keeps_the_last_lines_for_the_panel(void**) {
  for (int i = 0; i < 300; ++i) {
    log_info("a", "line {}", i);
    drain_log(-1);
  }
  Recent recent{};
  const auto look = [](void* context, std::uint64_t, std::string_view) {
    ++static_cast<Recent*>(context)->count;
  };
  const std::uint64_t last = visit_recent_log(0, &recent, look);
  assert_int_equal(recent.count, 200);
  recent.count = 0;
  visit_recent_log(last - 3, &recent, look);
  assert_int_equal(recent.count, 3);
  recent.count = 0;
  assert_int_equal(visit_recent_log(last, &recent, look), last);
  assert_int_equal(recent.count, 0);
}

void says_a_repeated_warning_once_a_second(void**) {
  LogLimit limit;
  Time now = at(5);
  set_log_clock(&now);
  for (int i = 0; i < 10; ++i) {
    log_warning(limit, "a", "late");
    now += std::chrono::milliseconds(50);
  }
  assert_string_equal(last_line(), "[   5.000000] warning a: late");
  assert_int_equal(limit.held_back(), 9);
  assert_int_equal(drain_log(-1), 0);
  now = at(6);
  log_warning(limit, "a", "late");
  assert_string_equal(last_line(), "[   6.000000] warning a: late (9 more since)");
  log_error(limit, "a", "late");
  assert_int_equal(drain_log(-1), 0);
  set_log_clock(nullptr);
}

struct Collected {
  std::uint64_t last[4] = {};  ///< number of each thread's last message
  std::uint64_t lines = 0;
  bool ordered = true;
};

void collect(Collected& collected) {
  while (const LogRecord* const record = process_log_ring().front()) {
    std::uint64_t& last = collected.last[record->source[1] - '0'];
    const std::uint64_t number = record->values[0].unsigned_integer;
    collected.ordered = collected.ordered && number > last;
    last = number;
    ++collected.lines;
    process_log_ring().pop();
  }
}

/// Four threads log numbered messages until enough were collected. @returns messages said.
std::uint64_t log_from_four_threads(Collected& collected) {
  static const char* const names[4] = {"t0", "t1", "t2", "t3"};
  std::atomic<bool> enough{false};
  std::atomic<std::uint64_t> said{0};
  std::vector<std::thread> threads;
  for (const char* const name : names)
    threads.emplace_back([name, &enough, &said] {
      std::uint64_t number = 0;
      while (!enough.load(std::memory_order_relaxed)) log_error(name, "{}", ++number);
      said.fetch_add(number);
    });
  while (collected.lines < 20'000) collect(collected);
  enough = true;
  for (std::thread& thread : threads) thread.join();
  collect(collected);
  return said;
}

void loses_nothing_uncounted(void**) {
  Collected collected;
  const std::uint64_t dropped_before = dropped_log_messages();
  const std::uint64_t said = log_from_four_threads(collected);
  assert_true(collected.ordered);
  assert_int_equal(collected.lines + dropped_log_messages() - dropped_before, said);
}

/// A pipe that takes no more than it has: whoever writes into it waits.
struct FullPipe {
  FullPipe() {
    if (pipe(ends) != 0) return;
    fcntl(ends[1], F_SETFL, O_NONBLOCK);
    const char block[512] = {};
    while (write(ends[1], block, sizeof(block)) > 0) {
    }
    fcntl(ends[1], F_SETFL, 0);
  }
  ~FullPipe() {
    close(ends[0]);
    close(ends[1]);
  }
  /// Until all that was written is read: everything before the first line of the log is filling.
  std::string rest() {
    close(ends[1]);
    ends[1] = -1;
    std::string text;
    char block[4096];
    for (ssize_t count = 0; (count = read(ends[0], block, sizeof(block))) > 0;)
      text.append(block, static_cast<std::size_t>(count));
    return text.substr(std::min(text.find('['), text.size()));
  }
  int ends[2] = {-1, -1};
};

// [stop-57] [stop-58]
void a_reader_that_takes_nothing_holds_up_nobody_else(void**) {
  static std::string written;
  static std::size_t relieved;
  relieved = 0;
  {
    FullPipe pipe;
    log_info("a", "first");
    std::thread writer([&pipe] {
      drain_log(pipe.ends[1]);
      log_info("a", "last");
      drain_log(pipe.ends[1]);
    });
    // While the writer waits, others take over; what they took is in the recent lines.
    for (int number = 0; relieved < 5; ++number) {
      if (number < 5) log_info("a", "number {}", number);
      relieved += relieve_log(std::chrono::milliseconds{20});
      std::this_thread::sleep_for(std::chrono::milliseconds{5});
    }
    assert_string_equal(std::strstr(last_line(), "info"), "info a: number 4");
    // Somebody reads at last.
    char block[65536];
    assert_true(read(pipe.ends[0], block, sizeof(block)) > 0);
    writer.join();
    written = pipe.rest();
  }
  assert_int_equal(relieved, 5);
  assert_true(written.find("a: first\n") != std::string::npos);
  assert_true(written.find("number") == std::string::npos);
  assert_true(written.find("warning log: 5 lines were not written here: nobody read them in time") !=
              std::string::npos);
  assert_true(written.find("a: last\n") != std::string::npos);
}

// [stop-57] [stop-58]
void lines_that_cannot_be_written_are_counted(void**) {
  const int full = open("/dev/full", O_WRONLY);
  const std::uint64_t before = unwritten_log_lines();
  for (int number = 0; number < 3; ++number) log_info("a", "number {}", number);
  drain_log(full);
  close(full);
  assert_int_equal(unwritten_log_lines() - before, 3);
  assert_string_equal(std::strstr(last_line(), "info"), "info a: number 2");
}

}  // namespace
}  // namespace flexrf

int main() {
  using namespace flexrf;
  const CMUnitTest tests[] = {
      cmocka_unit_test_setup(formats_every_kind_of_argument, start_clean),
      cmocka_unit_test_setup(copies_text_and_cuts_what_is_too_long, start_clean),
      cmocka_unit_test_setup(counts_time_from_the_origin, start_clean),
      cmocka_unit_test_setup(leaves_out_what_is_below_the_threshold, start_clean),
      cmocka_unit_test_setup(writes_a_line_per_message, start_clean),
      cmocka_unit_test_setup(counts_drops_and_says_so, start_clean),
      cmocka_unit_test_setup(keeps_the_last_lines_for_the_panel, start_clean),
      cmocka_unit_test_setup(says_a_repeated_warning_once_a_second, start_clean),
      cmocka_unit_test_setup(loses_nothing_uncounted, start_clean),
      cmocka_unit_test_setup(a_reader_that_takes_nothing_holds_up_nobody_else, start_clean),
      cmocka_unit_test_setup(lines_that_cannot_be_written_are_counted, start_clean),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
