#include "hal/operator/keyboard/terminal/terminal_keyboard.hpp"

#include <poll.h>
#include <sys/epoll.h>
#include <sys/timerfd.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "hal/operator/keyboard/terminal/raw_terminal.hpp"
#include "runtime/realtime/signals.hpp"

namespace flexrf {
namespace {

constexpr int input = STDIN_FILENO;
constexpr std::uint8_t end_of_transmission = 0x04;  // Ctrl-D
// A terminal sends an escape sequence in one go; a person's next key comes later than this.
constexpr Duration sequence_timeout = std::chrono::milliseconds(30);
// A writer as fast as this reader, of keys or of what is none, must not hold the thread for ever.
constexpr int most_bytes_per_cycle = 64;

bool watch(int set, int descriptor) {
  epoll_event event{};
  event.events = EPOLLIN;
  return epoll_ctl(set, EPOLL_CTL_ADD, descriptor, &event) == 0;
}

}  // namespace

TerminalKeyboard::~TerminalKeyboard() {
  stop();
}

Status TerminalKeyboard::initialise() {
  stop();
  decoder_ = {};
  ended_ = false;
  away_ = false;
  waiting_ = false;
  rests_ = false;
  terminal_ = isatty(input) == 1;
  timer_ = timerfd_create(CLOCK_MONOTONIC, TFD_NONBLOCK | TFD_CLOEXEC);
  own_wait_ = epoll_create1(EPOLL_CLOEXEC);
  if (timer_ < 0 || own_wait_ < 0 || !watch(own_wait_, timer_)) {
    return Status::error(StatusCode::internal, "cannot wait for keys: %s", std::strerror(errno));
  }
  // A plain file cannot be watched, and is always readable.
  wait_ = watch(own_wait_, input) ? own_wait_ : input;
  return terminal_ ? raw_terminal::enter(input) : Status{};
}

void TerminalKeyboard::stop() {
  if (terminal_) raw_terminal::leave();
  terminal_ = false;
  for (int* descriptor : {&timer_, &own_wait_}) {
    if (*descriptor >= 0) close(*descriptor);
    *descriptor = -1;
  }
  wait_ = -1;
}

void TerminalKeyboard::receive(const Tick& tick) noexcept {
  bytes_left_ = most_bytes_per_cycle;
  events_ = 0;
  TerminalKeyboardDriver::receive(tick);
  // Bytes that are no key presses may come for ever.
  const bool only_noise = bytes_left_ == 0 && events_ == 0;
  const bool rest = is_backed_up() || ended_ || away_ || only_noise;
  if (!rest && !rests_) return;
  rests_ = rest;
  if (waiting_) return;  // the timer runs already
  // Setting it also makes it unreadable again.
  set_timer(rest ? retry_interval : Duration{});
}

std::optional<KeyEvent> TerminalKeyboard::read() noexcept {
  std::uint8_t byte = 0;
  // No byte is read ahead of need: what nobody has room for stays in the pipe and holds up its writer.
  while (!decoder_.has_event() && !ended_ && bytes_left_ > 0 && read_byte(byte)) {
    --bytes_left_;
    take_byte(byte);
  }
  if (decoder_.is_undecided() && !decoder_.has_event()) {
    if (ended_ || has_waited()) {
      decoder_.decide();
      await_rest_of_sequence(false);
    } else {
      await_rest_of_sequence(true);
    }
  } else {
    await_rest_of_sequence(false);
  }
  const std::optional<KeyEvent> event = decoder_.take();
  if (event) ++events_;
  return event;
}

void TerminalKeyboard::take_byte(std::uint8_t byte) noexcept {
  if (terminal_ && byte == end_of_transmission) {
    ended_ = true;
  } else if (terminal_ || (byte != '\n' && byte != '\r')) {
    decoder_.put(byte);
  }
}

/// False when there is none now; at the end, ended_ becomes true, and away_ while the terminal is another
/// process's: the keys that are typed there are for that one. Standard input is shared with the shell, so
/// it is not made non-blocking but asked first.
bool TerminalKeyboard::read_byte(std::uint8_t& byte) noexcept {
  pollfd ready{input, POLLIN, 0};
  if (poll(&ready, 1, 0) <= 0) return false;
  const ssize_t count = (ready.revents & POLLNVAL) != 0 ? 0 : ::read(input, &byte, 1);
  if (count < 0 && (errno == EINTR || errno == EAGAIN)) return false;
  away_ = count < 0 && errno == EIO && terminal_ && signals::is_in_background(input);
  ended_ = count <= 0 && !away_;
  return count > 0;
}

void TerminalKeyboard::await_rest_of_sequence(bool on) noexcept {
  if (on == waiting_) return;
  waiting_ = on;
  set_timer(on ? sequence_timeout : Duration{});
}

/// Once, after this time; zero: not at all.
void TerminalKeyboard::set_timer(Duration after) noexcept {
  itimerspec setting{};
  setting.it_value.tv_nsec = after.count();
  timerfd_settime(timer_, 0, &setting, nullptr);
}

bool TerminalKeyboard::has_waited() noexcept {
  std::uint64_t expirations = 0;
  return waiting_ && ::read(timer_, &expirations, sizeof(expirations)) == sizeof(expirations);
}

}  // namespace flexrf
