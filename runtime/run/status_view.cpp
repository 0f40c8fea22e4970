#include "runtime/run/status_view.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/ioctl.h>

#include <cstdlib>
#include <cstring>

#include "base/text_table.hpp"
#include "runtime/log/log.hpp"

namespace flexrf {
namespace {

constexpr Duration frame_interval = std::chrono::milliseconds{200};
constexpr int patience_at_the_end = 500;  // ms, for a terminal that does not take the last frame

// ECMA-48 control sequences, and the synchronised update of newer terminals (others pass it over).
constexpr std::string_view begin_update = "\x1b[?2026h";
constexpr std::string_view end_update = "\x1b[?2026l";
constexpr std::string_view erase_line = "\x1b[K";
constexpr std::string_view erase_below = "\x1b[J";
constexpr std::string_view erase_all = "\x1b[H\x1b[2J";
constexpr std::string_view plain = "\x1b[0m";
// A keyboard in raw mode may have switched off that a line feed returns the carriage.
constexpr std::string_view next_line = "\r\n";

std::string_view sequence_of(StatusLine::Style style) noexcept {
  switch (style) {
    case StatusLine::Style::plain:
      return "";
    case StatusLine::Style::title:
      return "\x1b[1m";
    case StatusLine::Style::alarm:
      return "\x1b[1;31m";
    case StatusLine::Style::faint:
      return "\x1b[2m";
  }
  return "";
}

/// Causes and texts come from anywhere; none may steer the terminal.
std::string without_controls(std::string text) {
  for (char& character : text) {
    if (static_cast<unsigned char>(character) < 0x20 || character == 0x7F) character = ' ';
  }
  return text;
}

}  // namespace

bool StatusView::is_possible(int descriptor) noexcept {
  const char* terminal = std::getenv("TERM");
  return isatty(descriptor) == 1 && terminal != nullptr && *terminal != '\0' &&
         std::strcmp(terminal, "dumb") != 0;
}

std::unique_ptr<TerminalView> StatusView::make(Cell& cell) {
  return is_possible() ? std::make_unique<StatusView>(cell) : nullptr;
}

StatusView::StatusView(Cell& cell, int descriptor) : content_(cell), descriptor_(descriptor) {
  // What was logged before has been shown elsewhere.
  logged_ = visit_recent_log(~std::uint64_t{0}, nullptr, [](void*, std::uint64_t, std::string_view) {});
  char name[64];
  if (ttyname_r(descriptor, name, sizeof(name)) != 0) return;
  const int own = open(name, O_WRONLY | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  if (own < 0) return;
  descriptor_ = own;
  owns_descriptor_ = true;
}

StatusView::Size StatusView::size() const noexcept {
  winsize window{};
  if (ioctl(descriptor_, TIOCGWINSZ, &window) != 0 || window.ws_row == 0 || window.ws_col == 0)
    return {24, 80};
  return {window.ws_row, window.ws_col};
}

void StatusView::rewind(std::string& frame) const {
  frame += '\r';
  if (drawn_rows_ > 1) frame += "\x1b[" + std::to_string(drawn_rows_ - 1) + "A";
}

void StatusView::add_log(std::string& frame) {
  logged_ = visit_recent_log(logged_, &frame, [](void* context, std::uint64_t, std::string_view text) {
    auto& lines = *static_cast<std::string*>(context);
    lines += without_controls(std::string{text});
    lines += erase_line;
    lines += next_line;
  });
}

void StatusView::draw(Time now) {
  if (finished_ || (drawn_at_ != Time{} && now - drawn_at_ < frame_interval)) return;
  drawn_at_ = now;
  if (!flush()) return;
  const Size room = size();
  std::string frame{begin_update};
  if (room != drawn_size_ && drawn_rows_ > 0) {
    // What the terminal made of the lines at another width is not known.
    frame += erase_all;
  } else {
    rewind(frame);
  }
  add_log(frame);
  // The cursor stays in the last line of the view: the last row of the terminal at most.
  const std::vector<StatusLine> lines = content_.lines(now, room.rows > 1 ? room.rows - 1 : 1);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (i > 0) frame += next_line;
    frame += sequence_of(lines[i].style);
    // The last column stays free: terminals do not agree on where the cursor is after it.
    frame += cut_text(without_controls(lines[i].text), room.columns - 1);
    frame += plain;
    frame += erase_line;
  }
  frame += erase_below;
  frame += end_update;
  drawn_rows_ = lines.size();
  drawn_size_ = room;
  pending_ = std::move(frame);
  flush();
}

void StatusView::finish() {
  if (finished_) return;
  finished_ = true;
  std::string frame;
  if (drawn_rows_ > 0) {
    rewind(frame);
    frame += erase_below;
  }
  add_log(frame);
  pending_ += frame;
  pollfd terminal{descriptor_, POLLOUT, 0};
  while (!flush() && poll(&terminal, 1, patience_at_the_end) > 0) {
  }
  if (owns_descriptor_) close(descriptor_);
}

/// True when nothing is left to write.
bool StatusView::flush() {
  while (!pending_.empty()) {
    pollfd terminal{descriptor_, POLLOUT, 0};
    if (poll(&terminal, 1, 0) <= 0 || (terminal.revents & POLLOUT) == 0) return false;
    const ssize_t written = write(descriptor_, pending_.data(), pending_.size());
    if (written <= 0) return false;
    pending_.erase(0, static_cast<std::size_t>(written));
  }
  return true;
}

}  // namespace flexrf
