#include "hal/process/interface/process_run.hpp"

#include <algorithm>
#include <cstdarg>
#include <cstdio>

#include "runtime/log/log.hpp"

namespace flexrf {
namespace {

/// What is read of one source in a cycle: a program that prints without end must not hold the thread.
constexpr int reads_per_cycle = 8;
constexpr std::size_t read_size = 4096;
/// A program's children may keep its output open for ever; its own last bytes are in the pipe when it ends.
constexpr Duration most_draining = std::chrono::milliseconds(200);
/// After a kill: what does not end then waits in the kernel, and nobody can end it.
constexpr Duration kill_timeout = std::chrono::seconds(1);
constexpr Duration look_interval = std::chrono::milliseconds(20);

}  // namespace

Status ProcessRun::begin(const char* name, ProcessHost& host, const ProcessSettings& settings) {
  name_ = name;
  host_ = &host;
  settings_ = settings;
  settings_.restart = ProcessRestart::never;  // what cannot be started at first is not tried for ever
  state_ = {};
  lines_.restart();
  input_.use(input_memory_);
  wanted_ = lost_ = ended_ = false;
  kills_ = refused_writes_ = 0;
  trouble_ = {};
  pause_ = settings.restart_shortest;
  if (!settings.start) {
    settings_.restart = settings.restart;
    return {};
  }
  const Time began = MonotonicClock::now();
  start(began);
  if (state_.phase != ProcessPhase::starting) {
    return Status::error(StatusCode::unavailable, "what starts programs does not take the order");
  }
  while (state_.phase == ProcessPhase::starting) {
    const Duration left = began + settings.start_timeout - MonotonicClock::now();
    if (left <= Duration{}) {
      stop();
      return Status::error(StatusCode::timeout, "its own code does not begin within %.3g s",
                           seconds(settings.start_timeout));
    }
    host.wait(std::min(left, look_interval));
    take_events(MonotonicClock::now());
  }
  settings_.restart = settings.restart;
  // The run may even be over: it was one.
  if (state_.phase == ProcessPhase::running) return {};
  return Status::error(StatusCode::not_found, "%.*s", static_cast<int>(text_view(trouble_).size()),
                       trouble_.data());
}

void ProcessRun::stop() noexcept {
  wanted_ = false;
  if (host_ == nullptr) return;
  if (is_alive() && !ended_) {
    const Time began = MonotonicClock::now();
    host_->end(settings_.stop_timeout == Duration{});
    bool killed = killed_ || settings_.stop_timeout == Duration{};
    Time killed_at = began;
    while (is_alive() && !ended_) {
      const Time now = MonotonicClock::now();
      if (!killed && now - began >= settings_.stop_timeout) {
        log_warning(name_, "it did not end within stop_timeout, and is killed");
        host_->end(true);
        killed = true;
        killed_at = now;
        ++kills_;
      }
      host_->wait(look_interval);
      const Time heard = MonotonicClock::now();
      take_events(heard);
      drain(heard);
      // From the kill on, and by the time before it was looked: this thread may be held up itself.
      if (is_alive() && !ended_ && killed && now - killed_at >= kill_timeout) {
        log_error(name_, "it was killed and does not end; it waits for the kernel, and is left behind");
        break;
      }
    }
  }
  host_->release();
  input_.clear();
  state_.phase = ProcessPhase::idle;
  state_.id = 0;
  ended_ = false;
}

void ProcessRun::receive(Time now) noexcept {
  take_events(now);
  const bool drained = is_alive() && drain(now);
  if (ended_ && (drained || now - ended_at_ >= most_draining)) finish_run(now);
  watch_time(now);
}

void ProcessRun::send(Time now) noexcept {
  if (wanted_ && state_.phase == ProcessPhase::idle && !lost_) start(now);
  if (!wanted_ && state_.phase == ProcessPhase::waiting) enter(ProcessPhase::idle, now);
  if (!wanted_ && !ended_ &&
      (state_.phase == ProcessPhase::running || state_.phase == ProcessPhase::starting)) {
    host_->end(settings_.stop_timeout == Duration{});
    enter(ProcessPhase::stopping, now);
  }
  if (state_.phase == ProcessPhase::running) feed();
}

bool ProcessRun::write(std::string_view bytes, bool as_line) noexcept {
  const bool takes = state_.phase == ProcessPhase::running && !ended_ && !input_ends_;
  if (!takes || bytes.size() + (as_line ? 1 : 0) > input_.room()) {
    ++refused_writes_;
    return false;
  }
  return input_.put(bytes) && (!as_line || input_.put("\n"));
}

bool ProcessRun::is_alive() const noexcept {
  return state_.phase == ProcessPhase::starting || state_.phase == ProcessPhase::running ||
         state_.phase == ProcessPhase::stopping;
}

void ProcessRun::enter(ProcessPhase phase, Time now) noexcept {
  state_.phase = phase;
  state_.since = nanoseconds(now);
}

void ProcessRun::start(Time now) noexcept {
  input_.clear();
  ended_ = killed_ = input_ends_ = input_closed_ = false;
  source_ended_ = {};
  wanted_ = true;
  if (!host_->start()) return;  // tried again in the next cycle
  lines_.begin_run(++state_.runs);
  began_at_ = now;
  enter(ProcessPhase::starting, now);
}

void ProcessRun::take_events(Time now) noexcept {
  ProcessEvent event;
  while (host_->next_event(event)) {
    lost_ = lost_ || event.last;
    switch (event.kind) {
      case ProcessEvent::Kind::started:
        state_.id = event.id;
        source_ended_ = {};
        if (!killed_) trouble_ = {};
        if (state_.phase == ProcessPhase::starting) enter(ProcessPhase::running, now);
        break;
      case ProcessEvent::Kind::refused:
        if (!is_alive()) break;
        state_.end = ProcessEnd::not_started;
        note_trouble("%s", event.cause.cause());
        finish_run(now);
        break;
      case ProcessEvent::Kind::ended:
        if (is_alive()) take_end(event, now);
        break;
    }
  }
}

void ProcessRun::take_end(const ProcessEvent& event, Time now) noexcept {
  ended_ = true;
  ended_at_ = now;
  // It may have ended since this cycle began, and is told as a part of it.
  state_.ended_at = nanoseconds(event.at == Time{} ? now : std::min(event.at, now));
  state_.end = event.signal == 0 ? ProcessEnd::exited : ProcessEnd::signalled;
  state_.exit_code = event.code;
  state_.end_signal = event.signal;
  const bool by_itself = state_.phase != ProcessPhase::stopping && !killed_;
  if (event.last) {
    note_trouble("%s", event.cause.cause());
  } else if (by_itself && event.signal != 0) {
    note_trouble("it was ended by signal %d", event.signal);
  } else if (by_itself && event.code != 0) {
    note_trouble("it exited with code %d", event.code);
  }
}

/// True when no more will come.
bool ProcessRun::drain(Time now) noexcept {
  std::array<char, read_size> bytes;
  for (const ProcessSource source : {ProcessSource::output, ProcessSource::error}) {
    bool& ended = source_ended_[static_cast<std::size_t>(source)];
    for (int n = 0; n < reads_per_cycle && !ended; ++n) {
      const long count = host_->read(source, bytes);
      ended = count < 0;
      if (count <= 0) break;
      lines_.put(source, {bytes.data(), static_cast<std::size_t>(count)}, now);
    }
  }
  return source_ended_[0] && source_ended_[1];
}

void ProcessRun::finish_run(Time now) noexcept {
  lines_.finish(now);
  host_->release();
  input_.clear();
  ended_ = false;
  state_.id = 0;
  const bool failed = state_.end != ProcessEnd::exited || state_.exit_code != 0;
  const bool again = settings_.restart == ProcessRestart::always ||
                     (settings_.restart == ProcessRestart::on_failure && failed);
  if (state_.phase == ProcessPhase::stopping) {
    // Ended as it was asked to; a start that was asked for since begins at once.
    enter(ProcessPhase::idle, now);
  } else if (wanted_ && again && !lost_) {
    if (now - began_at_ >= settings_.restart_longest) pause_ = settings_.restart_shortest;
    restart_at_ = now + pause_;
    pause_ = std::min(2 * pause_, std::max(settings_.restart_longest, settings_.restart_shortest));
    log_warning(name_, "{}; started again in {:.3} s", text_view(trouble_), seconds(restart_at_ - now));
    enter(ProcessPhase::waiting, now);
  } else {
    wanted_ = false;
    enter(ProcessPhase::idle, now);
  }
}

void ProcessRun::watch_time(Time now) noexcept {
  const Duration spent = now - Time{Duration{state_.since}};
  if (state_.phase == ProcessPhase::waiting && now >= restart_at_ && wanted_) {
    start(now);
  } else if (state_.phase == ProcessPhase::starting && spent >= settings_.start_timeout && !killed_) {
    killed_ = true;
    ++kills_;
    note_trouble("its own code does not begin within %.3g s", seconds(settings_.start_timeout));
    host_->end(true);
  } else if (state_.phase == ProcessPhase::stopping && !ended_ && spent >= settings_.stop_timeout &&
             !killed_) {
    killed_ = true;
    ++kills_;
    log_warning(name_, "it did not end within stop_timeout, and is killed");
    host_->end(true);
  }
}

void ProcessRun::feed() noexcept {
  while (!input_.is_empty()) {
    const long count = host_->write(input_.front());
    if (count < 0) {
      // It has closed its input: what is left is for nobody.
      input_.clear();
      input_ends_ = true;
    }
    if (count <= 0) break;
    input_.drop(static_cast<std::size_t>(count));
  }
  if (input_ends_ && input_.is_empty() && !input_closed_) {
    host_->close_input();
    input_closed_ = true;
  }
}

void ProcessRun::note_trouble(const char* format, ...) noexcept {
  std::array<char, sizeof(trouble_)> text{};
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(text.data(), text.size(), format, arguments);
  va_end(arguments);
  trouble_ = text;
}

void ProcessRun::fill(ProcessFeedback& feedback) const noexcept {
  feedback.phase = state_.phase;
  feedback.id = state_.id;
  feedback.runs = state_.runs;
  feedback.end = state_.end;
  feedback.exit_code = state_.exit_code;
  feedback.end_signal = state_.end_signal;
  feedback.kills = kills_;
  feedback.lines = lines_.lines();
  feedback.dropped_lines = lines_.dropped();
  feedback.cut_lines = lines_.cut();
  feedback.refused_writes = refused_writes_;
  feedback.trouble = trouble_;
}

}  // namespace flexrf
