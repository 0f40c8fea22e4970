#include "runtime/executive/output_thread.hpp"

#include <unistd.h>

#include <cerrno>
#include <ctime>
#include <string_view>

#include "runtime/log/log.hpp"
#include "runtime/parameters/durable_file.hpp"

namespace flexrf {
namespace {

constexpr timespec turn_interval{0, 10'000'000};
/// A reader that takes nothing for so long is stuck.
constexpr Duration log_patience = std::chrono::milliseconds{200};

Status write_text(int descriptor, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = write(descriptor, text.data(), text.size());
    if (written < 0) {
      return Status::error(StatusCode::unavailable,
                           "standard output: %s (the report is not there as a whole)",
                           cause_of(errno).c_str());
    }
    text.remove_prefix(static_cast<std::size_t>(written));
  }
  return {};
}

}  // namespace

OutputThread::~OutputThread() {
  ends_.store(true, std::memory_order_release);
  thread_.join();
  // What was said names the application's parts, which may be gone when somebody else would write it.
  drain_log(STDERR_FILENO);
}

Status OutputThread::start() noexcept {
  ThreadSettings settings;
  settings.name = "output";
  return thread_.start(
      settings, [](void* self) { static_cast<OutputThread*>(self)->run(); }, this);
}

void OutputThread::observe() noexcept {
  if (thread_.is_started()) {
    relieve_log(log_patience);
  } else {
    // Nothing was started either: nobody needs the time.
    drain_log(STDERR_FILENO);
  }
}

void OutputThread::catch_up() noexcept {
  // The turn that is under way may have looked before.
  const std::uint32_t enough = turns_.load(std::memory_order_acquire) + 2;
  const Time give_up = MonotonicClock::now() + 2 * log_patience;
  do {
    observe();
    if (!thread_.is_started()) return;
    nanosleep(&turn_interval, nullptr);
  } while (static_cast<std::int32_t>(turns_.load(std::memory_order_acquire) - enough) < 0 &&
           MonotonicClock::now() < give_up);
}

void OutputThread::begin_end(std::vector<std::string> texts) noexcept {
  texts_ = std::move(texts);
  ends_.store(true, std::memory_order_release);
  if (!thread_.is_started()) run();
}

void OutputThread::run() noexcept {
  std::unique_ptr<TerminalView> view;
  if (make_view_ != nullptr) view = make_view_(*cell_);
  // Where the log would go to the terminal that the view is in, the view shows it.
  const int log = view && isatty(STDERR_FILENO) == 1 ? -1 : STDERR_FILENO;
  while (!ends_.load(std::memory_order_acquire)) {
    drain_log(log);
    if (view) view->draw(MonotonicClock::now());
    turns_.fetch_add(1, std::memory_order_release);
    nanosleep(&turn_interval, nullptr);
  }
  drain_log(log);
  view.reset();
  write_texts();
  ended_.store(true, std::memory_order_release);
}

void OutputThread::write_texts() noexcept {
  for (const std::string& text : texts_) {
    if (failure_) failure_ = write_text(STDOUT_FILENO, text);
  }
}

}  // namespace flexrf
