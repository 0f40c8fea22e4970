#include "runtime/run/status_view.hpp"

#include <fcntl.h>
#include <pty.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "base/text_table.hpp"
#include "runtime/executive/tests/running_cell.hpp"
#include "runtime/log/log.hpp"

namespace flexrf::fixture {
namespace {

using std::chrono::milliseconds;
using Cell = ProducerAndConsumer;

constexpr Time beginning{std::chrono::seconds{1}};

std::string text_of(const std::vector<StatusLine>& lines) {
  std::string text;
  for (const StatusLine& line : lines) text += line.text + "\n";
  return text;
}

/// A cell that has run, with a producer in fault.
struct Ended {
  explicit Ended() {
    cell.unit(Cell::producer).script.step = [](TestUnit& unit, const Tick& tick) {
      unit.feedback = {tick.number, 0.123456};
      if (tick.number == 5) unit.fail(Status::error(StatusCode::device_fault, "slipped"));
    };
    for (int i = 0; i < 10; ++i) {
      UnitPlan more;
      more.name = "more" + std::to_string(i);
      cell.thread(Cell::producing).units.push_back(cell.add(std::move(more)));
    }
    executive.emplace(cell.application(), in_virtual_time(milliseconds{20}));
    run_to_the_end(*executive);
  }
  Cell cell;
  std::optional<Executive> executive;
};

void the_content_names_what_matters() {
  Ended ended;
  StatusContent content(ended.executive->cell());
  const std::string text = text_of(content.lines(beginning, 100));
  CHECK_CONTAINS(text, "test_cell  ended");
  CHECK_CONTAINS(text, "fault: producer: slipped\n");
  CHECK_CONTAINS(text, "Ctrl-C ends.  producer: Follows its script.  producer: Arrows move it.  consumer: ");
  CHECK_CONTAINS(text, "producing");
  CHECK_CONTAINS(text, "actuator (mock)");
  CHECK_CONTAINS(text, "steps 5, value 0.1235 m");
}

void what_does_not_fit_is_left_out_and_counted() {
  Ended ended;
  StatusContent content(ended.executive->cell());
  for (std::size_t rows = 1; rows < 20; ++rows) {
    const std::vector<StatusLine> lines = content.lines(beginning, rows);
    CHECK(lines.size() <= rows);
    CHECK_CONTAINS(lines[0].text, "test_cell");
    if (rows > 2) CHECK_CONTAINS(text_of(lines), "slipped");
  }
  CHECK_CONTAINS(text_of(content.lines(beginning, 12)), "... 8 more units\n");
}

/// A terminal whose other end the test reads.
struct Terminal {
  explicit Terminal(unsigned short rows, unsigned short columns) {
    winsize size{rows, columns, 0, 0};
    if (openpty(&master, &slave, nullptr, nullptr, &size) != 0) throw CheckFailed{"no pseudo terminal"};
    fcntl(master, F_SETFL, O_NONBLOCK);
  }
  ~Terminal() {
    close(master);
    close(slave);
  }
  void resize(unsigned short rows, unsigned short columns) {
    winsize size{rows, columns, 0, 0};
    ioctl(master, TIOCSWINSZ, &size);
  }
  std::string output() {
    std::string text;
    char bytes[4096];
    for (ssize_t count = read(master, bytes, sizeof(bytes)); count > 0;
         count = read(master, bytes, sizeof(bytes)))
      text.append(bytes, static_cast<std::size_t>(count));
    return text;
  }
  int master = -1;
  int slave = -1;
};

/// Widest line, control sequences left out.
std::size_t widest(const std::string& output) {
  std::size_t best = 0;
  std::size_t width = 0;
  for (std::size_t i = 0; i < output.size(); ++i) {
    if (output[i] == '\x1b') {
      i = output.find_first_of("ABCDEFGHJKmhl", i);
      if (i == std::string::npos) break;
    } else if (output[i] == '\n' || output[i] == '\r') {
      width = 0;
    } else {
      best = std::max(best, ++width);
    }
  }
  return best;
}

void frames_are_drawn_in_place_and_taken_away() {
  Terminal terminal(24, 60);
  Ended ended;
  drain_log(-1);
  {
    StatusView view(ended.executive->cell(), terminal.slave);
    view.draw(beginning);
    const std::string first = terminal.output();
    CHECK_CONTAINS(first, "test_cell");
    CHECK(widest(first) <= 59);
    CHECK(widest(first) > 40);
    view.draw(beginning + milliseconds{100});
    CHECK_EQUAL(terminal.output(), "");
    log_info("test", "a line between {}", "frames");
    drain_log(-1);
    view.draw(beginning + milliseconds{200});
    const std::string second = terminal.output();
    // Back to the first line of the frame before; the log first, the view below it.
    const auto rows = static_cast<std::size_t>(std::count(first.begin(), first.end(), '\n'));
    CHECK(rows > 5);
    CHECK_CONTAINS(second, "\r\x1b[");
    CHECK(second.find("A") != std::string::npos);
    CHECK(second.find("a line between frames") < second.find("test_cell  "));
    CHECK(second.find("\x1b[2J") == std::string::npos);
    view.finish();
    CHECK(terminal.output().ends_with("\x1b[J"));
    view.draw(beginning + milliseconds{900});
    CHECK_EQUAL(terminal.output(), "");
  }
}

void another_size_begins_a_clean_screen() {
  Terminal terminal(24, 80);
  Ended ended;
  StatusView view(ended.executive->cell(), terminal.slave);
  view.draw(beginning);
  terminal.output();
  terminal.resize(6, 30);
  view.draw(beginning + milliseconds{300});
  const std::string frame = terminal.output();
  CHECK_CONTAINS(frame, "\x1b[H\x1b[2J");
  // Below a view of at most five rows there is no line feed that would scroll.
  const std::size_t view_begins = frame.find("test_cell  ");
  CHECK(view_begins != std::string::npos);
  CHECK(std::count(frame.begin() + static_cast<std::ptrdiff_t>(view_begins), frame.end(), '\n') <= 4);
  CHECK(widest(frame.substr(view_begins)) <= 29);
}

void a_terminal_that_takes_nothing_holds_nobody_up() {
  Terminal terminal(50, 200);
  Ended ended;
  StatusView view(ended.executive->cell(), terminal.slave);
  // Nobody reads the other end: its buffer fills, and every draw() still returns.
  for (int i = 0; i < 500; ++i) view.draw(beginning + milliseconds{200 * i});
  std::string all;
  for (int i = 0; i < 100; ++i) {
    const std::string part = terminal.output();
    all += part;
    if (part.empty()) break;
    view.draw(beginning + milliseconds{200 * (600 + i)});
  }
  // What was taken are whole frames: none begins within another.
  std::size_t open = 0;
  for (std::size_t at = all.find("\x1b[?2026"); at != std::string::npos;
       at = all.find("\x1b[?2026", at + 1)) {
    open = all[at + 7] == 'h' ? open + 1 : open - 1;
    CHECK(open <= 1);
  }
}

void what_is_no_terminal_is_not_drawn_on() {
  int ends[2];
  CHECK_EQUAL(pipe(ends), 0);
  const bool possible = StatusView::is_possible(ends[1]);
  close(ends[0]);
  close(ends[1]);
  CHECK(!possible);
  Terminal terminal(24, 80);
  setenv("TERM", "xterm", 1);
  CHECK(StatusView::is_possible(terminal.slave));
  setenv("TERM", "dumb", 1);
  CHECK(!StatusView::is_possible(terminal.slave));
}

}  // namespace
}  // namespace flexrf::fixture

int main() {
  using namespace flexrf::fixture;
  const CMUnitTest tests[] = {
      CONTAINED_TEST(the_content_names_what_matters),
      CONTAINED_TEST(what_does_not_fit_is_left_out_and_counted),
      CONTAINED_TEST(frames_are_drawn_in_place_and_taken_away),
      CONTAINED_TEST(another_size_begins_a_clean_screen),
      CONTAINED_TEST(a_terminal_that_takes_nothing_holds_nobody_up),
      CONTAINED_TEST(what_is_no_terminal_is_not_drawn_on),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
