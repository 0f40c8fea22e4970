#include "hal/process/mock/mock_process_host.hpp"

#include <algorithm>
#include <csignal>
#include <ctime>

namespace flexrf {

MockProcessHost::MockProcessHost() {
  for (std::string& bytes : printed_) bytes.reserve(pipe_capacity);
  fed_.reserve(pipe_capacity);
}

bool MockProcessHost::print(ProcessSource source, std::string_view bytes) noexcept {
  std::string& printed = printed_[static_cast<std::size_t>(source)];
  if (!runs_ || printed.size() + bytes.size() > pipe_capacity) return false;
  printed.append(bytes);
  return true;
}

void MockProcessHost::lose(const Status& cause) noexcept {
  runs_ = false;
  ProcessEvent event;
  event.kind = ProcessEvent::Kind::ended;
  event.signal = SIGKILL;
  event.cause = cause;
  event.last = true;
  tell(event);
}

Status MockProcessHost::open(const ProcessProgram& program) {
  program_ = program;
  event_count_ = 0;
  return {};
}

/// A test's part is over when it is called: only the time goes by.
void MockProcessHost::wait(Duration most) noexcept {
  if (event_count_ > 0) return;
  const timespec pause{0, static_cast<long>(std::min<Duration>(most, std::chrono::milliseconds(5)).count())};
  nanosleep(&pause, nullptr);
}

bool MockProcessHost::start() noexcept {
  for (std::size_t i = 0; i < printed_.size(); ++i) {
    printed_[i].clear();
    read_[i] = 0;
  }
  fed_.clear();
  input_ended_ = false;
  ProcessEvent event;
  event.kind = refusal_.is_ok() ? ProcessEvent::Kind::started : ProcessEvent::Kind::refused;
  event.id = next_id_++;
  event.cause = refusal_;
  runs_ = refusal_.is_ok();
  tell(event);
  return true;
}

void MockProcessHost::end(bool at_once) noexcept {
  if (at_once || obeys_) finish(0, at_once ? SIGKILL : SIGTERM);
}

bool MockProcessHost::next_event(ProcessEvent& event) noexcept {
  if (event_count_ == 0) return false;
  event = events_[0];
  events_[0] = events_[1];
  --event_count_;
  return true;
}

long MockProcessHost::read(ProcessSource source, std::span<char> bytes) noexcept {
  const auto index = static_cast<std::size_t>(source);
  const std::string_view rest = std::string_view(printed_[index]).substr(read_[index]);
  const std::size_t count = std::min(rest.size(), bytes.size());
  std::copy_n(rest.data(), count, bytes.data());
  read_[index] += count;
  if (read_[index] == printed_[index].size()) {
    printed_[index].clear();
    read_[index] = 0;
  }
  if (count > 0) return static_cast<long>(count);
  return runs_ || leaves_open_ ? 0 : -1;
}

long MockProcessHost::write(std::string_view bytes) noexcept {
  if (!runs_) return -1;
  if (!reads_) return 0;
  const std::size_t count = std::min(bytes.size(), pipe_capacity - fed_.size());
  fed_.append(bytes.substr(0, count));
  return static_cast<long>(count);
}

void MockProcessHost::release() noexcept {
  for (std::size_t i = 0; i < printed_.size(); ++i) {
    printed_[i].clear();
    read_[i] = 0;
  }
}

void MockProcessHost::finish(int code, int signal) noexcept {
  if (!runs_) return;
  runs_ = false;
  ProcessEvent event;
  event.kind = ProcessEvent::Kind::ended;
  event.code = code;
  event.signal = signal;
  tell(event);
}

void MockProcessHost::tell(const ProcessEvent& event) noexcept {
  if (event_count_ < events_.size()) events_[event_count_++] = event;
}

}  // namespace flexrf
