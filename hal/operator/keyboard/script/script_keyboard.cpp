#include "hal/operator/keyboard/script/script_keyboard.hpp"

#include <sys/timerfd.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace flexrf {

ScriptKeyboard::~ScriptKeyboard() {
  stop();
}

Status ScriptKeyboard::initialise() {
  stop();
  const char* file = options().keys;
  if (file == nullptr) {
    return Status::error(StatusCode::invalid_argument,
                         "the script keyboard has no script; name one with --keys FILE");
  }
  auto script = read_key_script(file);
  if (!script) return script.status();
  keys_ = std::move(*script);
  next_ = 0;
  started_ = Time{};
  if (!environment().virtual_time) {
    timer_ = timerfd_create(CLOCK_MONOTONIC, TFD_NONBLOCK | TFD_CLOEXEC);
    if (timer_ < 0) {
      return Status::error(StatusCode::internal, "no timer for the script keyboard: %s",
                           std::strerror(errno));
    }
    arm_timer(Time{Duration{1}});  // due at once: the first cycle starts the script's clock
  }
  return {};
}

void ScriptKeyboard::stop() {
  if (timer_ >= 0) close(timer_);
  timer_ = -1;
}

void ScriptKeyboard::receive(const Tick& tick) noexcept {
  if (started_ == Time{}) started_ = tick.now;
  ScriptKeyboardDriver::receive(tick);
  if (timer_ >= 0) arm_timer(next_event());
}

std::optional<KeyEvent> ScriptKeyboard::read() noexcept {
  if (is_closed() || started_ == Time{} || now() < started_ + keys_[next_].after) return std::nullopt;
  return keys_[next_++].event;
}

Time ScriptKeyboard::next_event() const noexcept {
  if (started_ == Time{}) return Time{};
  if (is_closed()) return Time::max();
  const Time due = started_ + keys_[next_].after;
  return is_backed_up() ? std::max(due, now() + retry_interval) : due;
}

void ScriptKeyboard::arm_timer(Time when) noexcept {
  itimerspec setting{};  // zero disarms
  if (when != Time::max()) {
    const std::int64_t due = nanoseconds(when);
    setting.it_value.tv_sec = due / 1'000'000'000;
    setting.it_value.tv_nsec = due % 1'000'000'000;
  }
  timerfd_settime(timer_, TFD_TIMER_ABSTIME, &setting, nullptr);
}

}  // namespace flexrf
