#include "runtime/executive/executive.hpp"

#include <sched.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <future>
#include <optional>

#include "runtime/executive/heartbeat_watch.hpp"
#include "runtime/executive/job_control.hpp"
#include "runtime/executive/schedulability.hpp"
#include "runtime/executive/service_manager.hpp"
#include "runtime/executive/standstill.hpp"
#include "runtime/executive/trigger.hpp"
#include "runtime/executive/virtual_time.hpp"
#include "runtime/log/log.hpp"
#include "runtime/parameters/durable_file.hpp"
#include "runtime/realtime/last_gasp.hpp"
#include "runtime/realtime/machine_file.hpp"
#include "runtime/realtime/process_statistics.hpp"
#include "runtime/realtime/realtime_scope.hpp"
#include "runtime/realtime/rights.hpp"
#include "runtime/realtime/signals.hpp"
#include "runtime/realtime/system_call_filter.hpp"

namespace flexrf {
namespace {

constexpr Duration supervision_interval = std::chrono::milliseconds{5};
constexpr timespec lifecycle_pause{0, 10'000'000};
/// Of whoever ended the application, while others do not read what it says last.
constexpr Duration patience_with_readers = std::chrono::seconds{2};

/// Nobody asked for the end, nobody waits for it: readers have the time that they take.
bool is_unhurried(EndCause cause) noexcept {
  return cause == EndCause::end_of_input || cause == EndCause::virtual_time_over;
}

/// In virtual time there is no thread to wait for signals; the handler tells the control, which is all
/// atomics.
std::atomic<Control*> signalled_control{nullptr};
volatile std::sig_atomic_t last_signal = 0;

extern "C" void end_virtual_time(int signal) {
  last_signal = signal;
  // Whoever asks again does not want to wait for a reader that takes nothing: the next one ends the process.
  std::signal(signal, SIG_DFL);
  if (Control* control = signalled_control.load(); control != nullptr) {
    control->set_cause(EndCause::signal);
    control->rise_to(Mode::stopping);
  }
}

/// Bytes. All that is mapped is locked, code and libraries too: an application within its budget needs more.
std::size_t memory_to_lock(const Application& application, bool observed) noexcept {
  // The stacks of lifecycle, output and saver, and what the executive and the report allocate.
  constexpr std::size_t mapped_later = 4U << 20;
  // An observer's stacks, and the heaps that the allocator gives its threads.
  constexpr std::size_t mapped_by_observer = 12U << 20;
  const Result<ProcessStatistics> process = read_process_statistics();
  return process ? process->mapped + mapped_later + (observed ? mapped_by_observer : 0)
                 : application.memory_budget;
}

const char* did_of(ComponentAction action) noexcept {
  return action == ComponentAction::start  ? "started"
         : action == ComponentAction::stop ? "stopped"
                                           : "initialised";
}
const char* tried_of(ComponentAction action) noexcept {
  return action == ComponentAction::start  ? "tried to start a component"
         : action == ComponentAction::stop ? "tried to stop a component"
                                           : "tried to initialise a component";
}

/// Configuration values as they are before they are changed.
class ConfigurationBefore {
 public:
  ConfigurationBefore(Cell& cell, const std::vector<ConfigurationChange>& changes) : cell_(&cell) {
    for (const ConfigurationChange& change : changes) {
      if (change.component < cell.component_count() &&
          std::none_of(values_.begin(), values_.end(),
                       [&](const Values& one) { return one.component == change.component; }))
        values_.push_back({change.component, copy(change.component)});
    }
  }
  void note(std::string_view who, const ReconfigureResult& result) const {
    if (result.outcome != ReconfigureOutcome::done) {
      std::string what = name_of(result.outcome);
      if (!result.causes.empty()) what += ": " + result.causes.front();
      return cell_->audit().note(who, "tried to change the configuration", what);
    }
    for (const Values& one : values_) {
      if (one.bytes.empty()) continue;
      const std::vector<std::byte> after = copy(one.component);
      cell_->audit().note_differences(who, one.component, ParameterKind::configuration,
                                      cell_->component_type(one.component).configuration, one.bytes.data(),
                                      after.data(), MonotonicClock::now());
    }
  }

 private:
  struct Values {
    ComponentIndex component;
    std::vector<std::byte> bytes;
  };
  // On the lifecycle thread, which alone writes them.
  std::vector<std::byte> copy(ComponentIndex component) const {
    const ParameterBlock& block = cell_->component_type(component).configuration;
    const auto* const values =
        static_cast<const std::byte*>(cell_->component(component).parameter_memory().configuration);
    if (block.type == nullptr || values == nullptr) return {};
    return {values, values + block.type->size};
  }

  Cell* cell_;
  std::vector<Values> values_;
};

/// Of the log. That a reader went away is his own affair: a pipe's (EPIPE), or a terminal's (EIO).
Status log_failure() {
  const int error = log_write_error();
  if (error == 0) return {};
  struct stat errors {};
  const bool is_file = fstat(STDERR_FILENO, &errors) == 0 && S_ISREG(errors.st_mode);
  if (!is_file && (error == EPIPE || error == EIO)) return {};
  return Status::error(StatusCode::unavailable, "standard error: %s (%llu lines of the log are not there)",
                       cause_of(error).c_str(), static_cast<unsigned long long>(unwritten_log_lines()));
}

}  // namespace

Executive::Executive(const Application& application, Options options)
    : options_(std::move(options)),
      cell_(application, options_),
      lifecycle_(cell_, !options_.virtual_time.has_value()),
      began_(MonotonicClock::now()),
      saver_(cell_),
      permit_(cell_.control(), application.name, options_.motion_permit_file),
      output_(cell_),
      audit_(cell_, options_) {}

/// After a run that got stuck: whoever hung may have let go since, else this waits.
Executive::~Executive() {
  join_threads();
  if (options_.virtual_time) set_log_clock(nullptr);
}

/// What is said around a run in virtual time has times of that clock, too: two runs say the same, and a
/// LogLimit that let something through before does not wait for a clock that is years ahead.
void Executive::use_log_time(Time time) noexcept {
  log_time_ = time;
  set_log_clock(&log_time_);
  set_log_origin(VirtualTime::beginning);
}

Status Executive::prepare() {
  if (options_.virtual_time) use_log_time(VirtualTime::beginning);
  if (const Status status = check_triggers(cell_.application()); !status) return status;
  if (const Status status = cell_.construct(); !status) return status;
  if (const Status status = saver_.load(); !status) return status;
  for (ComponentIndex i = 0; i < cell_.component_count(); ++i) cell_.note_configuration(i);
  if (const Status status = audit_.prepare(); !status) return status;
  for (DeviceState& state : cell_.application().device_states) {
    state.demands = state.device->guards_motion();
    state.guards.store(state.demands);
    if (state.demands) cell_.control().begin_demand();
  }
  if (options_.virtual_time) {
    cell_.prepare_virtual_time(options_.digest);
    return {};
  }
  if (!options_.realtime && cell_.real_actuator() != nullptr) {
    return Status::error(
        StatusCode::invalid_argument,
        "--no-realtime is refused: a real actuator is chosen (%s), and it must not be commanded late",
        cell_.real_actuator());
  }
  if (!options_.realtime) return {};
  RightsNeeded needed;
  for (const ThreadRecord& thread : cell_.application().threads) {
    needed.priority = std::max<int>(needed.priority, thread.priority);
  }
  needed.locked_bytes = memory_to_lock(cell_.application(), options_.observed);
  const RightsReport rights = probe_rights(needed);
  if (rights.is_complete()) return {};
  std::fprintf(stderr, "%s\n", rights.text);
  if (const char* const actuator = cell_.real_actuator(); actuator != nullptr) {
    std::fprintf(stderr, "A real actuator is chosen: %s.\n", actuator);
    return rights.status();
  }
  std::fprintf(stderr, "Going on without real time: no real actuator is chosen.\n");
  options_.realtime = false;
  return {};
}

ReconfigureResult Executive::reconfigure(std::vector<ConfigurationChange> changes) {
  std::promise<ReconfigureResult> result;
  reconfigure(std::move(changes), [&result](const ReconfigureResult& outcome) { result.set_value(outcome); });
  return result.get_future().get();
}

void Executive::reconfigure(std::vector<ConfigurationChange> changes, ReconfigureDone done,
                            std::string_view who) {
  const auto job = [this, changes = std::move(changes), done = std::move(done),
                    who = std::string{who}](bool ended) {
    const Status running = ended ? Status::error(StatusCode::not_permitted, "the application has ended")
                                 : cell_.control().check_running();
    if (!running) return done({ReconfigureOutcome::refused, {running.cause()}, {}});
    Reconfiguration host(cell_, lifecycle_);
    const ConfigurationBefore before(cell_, changes);
    const ReconfigureResult result = flexrf::reconfigure(host, changes);
    if (result.outcome == ReconfigureOutcome::done) note_set(cell_, changes);
    // Owners that were not initialised anew, too.
    for (const ConfigurationChange& change : changes) {
      if (change.component < cell_.component_count()) cell_.note_configuration(change.component);
    }
    before.note(who, result);
    done(result);
  };
  if (!lifecycle_.post([job] { job(false); })) job(true);
}

void Executive::act(ComponentAction action, ComponentIndex component, ActionDone done, std::string_view who) {
  const auto job = [this, action, component, done = std::move(done), who = std::string{who}](bool ended) {
    if (ended) return done(Status::error(StatusCode::not_permitted, "the application has ended"));
    const Status status = ComponentActions(cell_, lifecycle_).run(action, component);
    if (status) {
      cell_.audit().note(who, did_of(action), cell_.component_name(component));
      log_info(cell_.component_name(component), "{}: done", StaticText{name_of(action)});
    } else {
      cell_.audit().note(who, tried_of(action), status.cause());
      log_warning(cell_.application().name, "{}: {}", StaticText{name_of(action)}, status.cause());
    }
    done(status);
  };
  if (!lifecycle_.post([job] { job(false); })) job(true);
}

std::vector<ComponentIndex> Executive::owners_of(std::span<const ComponentIndex> changed) {
  return Reconfiguration(cell_, lifecycle_).owners_of(changed);
}

void Executive::request_end() noexcept {
  cell_.control().set_cause(EndCause::requested);
  cell_.control().rise_to(Mode::stopping);
}

RunSummary Executive::run() {
  RunSummary summary;
  if (!options_.virtual_time) set_log_origin(began_);
  if (cell_.application().autostart && options_.autostart) cell_.control().permit_motion_at_power_on();
  // Before anything is initialised, so that nothing moves that may not.
  permit_.observe(MonotonicClock::now());
  signals::ignore_what_writes_tell();
  if (options_.virtual_time) {
    run_in_virtual_time(summary);
    use_log_time(VirtualTime::beginning + summary.run_time);
  } else {
    run_on_the_wall_clock(summary);
  }
  summary.save_failure = saver_.finish();
  summary.writings = saver_.state().writings;
  output_.catch_up();
  summary.cause = cell_.control().cause();
  summary.wall_time = MonotonicClock::now() - began_;
  if (summary.start_failure.code() == StatusCode::not_permitted) {
    summary.exit_code = 3;
  } else if (summary.had_fault) {
    summary.exit_code = 2;
  } else if (!summary.save_failure) {
    summary.exit_code = 1;
  } else if (summary.cause == EndCause::signal) {
    summary.exit_code = 128 + summary.signal;
  }
  return summary;
}

std::vector<Status> Executive::say_last(std::vector<std::string> texts) {
  const sigset_t ending = signals::ending_set();
  const timespec interval{0, supervision_interval.count()};
  // False: the next signal came, or patience has come to its end.
  const auto wait_while = [&](bool patient, const auto& is_ending) {
    const Time begun = MonotonicClock::now();
    while (is_ending()) {
      const bool asked = sigtimedwait(&ending, nullptr, &interval) > 0;
      asked_to_end_ = asked_to_end_ || asked;
      if (asked || (!patient && MonotonicClock::now() - begun > patience_with_readers)) return false;
    }
    return true;
  };
  // What the audit says in the log comes before the end of it. A disk that hangs keeps nobody from the
  // report.
  audit_.begin_end();
  const bool audited = wait_while(false, [&] { return audit_.is_ending(); });
  output_.begin_end(std::move(texts));
  // Who asked while the run came to its end by itself asked for this, too.
  const bool unhurried = is_unhurried(cell_.control().cause()) && !asked_to_end_;
  const bool said = wait_while(unhurried, [&] { return output_.is_ending(); });
  std::vector<Status> failures;
  const auto note = [&failures](const Status& status) {
    if (!status) failures.push_back(status);
  };
  note(audited ? audit_.failure()
               : Status::error(StatusCode::unavailable, "the disk does not take the rest of the audit"));
  note(said ? output_.failure()
            : Status::error(StatusCode::timeout,
                            "nobody reads standard output or error; what is left to be said is not written"));
  note(log_failure());
  return failures;
}

void Executive::begin_running() noexcept {
  cell_.control().rise_to(Mode::running);
  const Application& application = cell_.application();
  if (!application.autostart) return;
  if (options_.autostart)
    log_warning(application.name, "autostart: actuators may move without a person's Start");
  else
    log_info(application.name, "autostart does not count (--no-autostart): nothing moves before a Start");
}

// ---- virtual time

void Executive::run_in_virtual_time(RunSummary& summary) {
  summary.virtual_time = true;
  Supervision supervision(cell_, lifecycle_, false);
  signalled_control = &cell_.control();
  struct sigaction action {};
  action.sa_handler = end_virtual_time;
  const sigset_t ending = signals::ending_set();
  for (const int signal : signals::ending) {
    if (sigismember(&ending, signal) == 1) sigaction(signal, &action, nullptr);
  }
  VirtualTime time(cell_, lifecycle_, supervision);
  const Status status = lifecycle_.start_all();
  if (status) {
    begin_running();
    summary.start_time = MonotonicClock::now() - began_;
  } else {
    log_error(cell_.application().name, "not started: {}", status.cause());
    cell_.control().set_cause(EndCause::fault);
    cell_.control().note_fault();
    cell_.control().rise_to(Mode::safe);
  }
  summary.run_time = time.run(*options_.virtual_time);
  lifecycle_.stop_all();
  lifecycle_.use_clock(nullptr);
  cell_.control().use_clock(nullptr);
  signalled_control = nullptr;
  summary.signal = last_signal;
  summary.had_fault = supervision.had_fault();
  summary.cut_short = supervision.was_cut_short();
  if (options_.digest) summary.digest = cell_.digest();
}

// ---- the wall clock

void Executive::run_on_the_wall_clock(RunSummary& summary) {
  // Every thread inherits the mask: only the supervising thread takes these signals, and it waits for them.
  const sigset_t awaited = signals::supervised_set();
  pthread_sigmask(SIG_BLOCK, &awaited, nullptr);
  alignas(16) static std::byte handler_stack[last_gasp::handler_stack_size];
  const last_gasp::AlternateStack crash_stack(handler_stack);
  Status status = last_gasp::install();
  last_gasp::expect_no_exit(true);
  prepare_allocation_guard();
  if (prepare_system_call_filter != nullptr) {
    if (const Status watch = prepare_system_call_filter(); !watch) {
      log_warning(cell_.application().name, "{}", watch.cause());
    }
  }
  if (status) status = start_threads(summary);
  if (!status) {
    log_error(cell_.application().name, "not started: {}", status.cause());
    cell_.control().set_cause(EndCause::fault);
    cell_.control().note_fault();
    cell_.control().rise_to(Mode::ended);
    summary.start_failure = status;
    summary.had_fault = true;
  }
  supervise(summary);
  last_gasp::expect_no_exit(false);
}

Status Executive::start_threads(RunSummary& summary) {
  const Application& application = cell_.application();
  const Result<MachineFile> machine = MachineFile::of_this_machine();
  if (!machine) return machine.status();
  if (options_.realtime) {
    if (const Status status = lock_all_memory(); !status) return status;
    summary.realtime = true;
  }
  CpuSet claimed;
  for (const ThreadRecord& thread : application.threads) {
    if (thread.priority > 0) claimed = claimed.united_with(machine->cpus_of(thread.role));
  }
  for (const std::optional<ThreadEstimate>& estimate : estimate_response_times(application, *machine)) {
    if (!estimate || estimate->result.meets_deadline) continue;
    char text[200];
    log_warning(estimate->task.name, "{}",
                describe_response_time(estimate->task, estimate->result, text, sizeof(text)));
  }
  const CpuSet rest = machine->rest(claimed);
  // The supervising, lifecycle, observing, saving, writing and library threads stay away from the real-time
  // ones.
  if (options_.realtime) sched_setaffinity(0, sizeof(cpu_set_t), &rest.mask());
  if (const Status status = output_.start(); !status) return status;
  if (const Status status = saver_.start(); !status) return status;
  if (const Status status = audit_.start(); !status) return status;
  if (observer_ != nullptr) {
    if (const Status status = start_observer(); !status) return status;
  }
  for (std::size_t i = 0; i < application.threads.size(); ++i) {
    ThreadLoop& loop = loops_.emplace_back(cell_, static_cast<std::uint16_t>(i));
    if (const Status status = loop.prepare(); !status) return status;
  }
  for (std::size_t i = 0; i < application.threads.size(); ++i) {
    const ThreadRecord& record = application.threads[i];
    ThreadSettings settings;
    settings.name = record.name;
    settings.stack = record.stack;
    settings.stack_size = record.stack_size;
    if (options_.realtime) {
      settings.priority = record.priority;
      settings.cpus = record.priority > 0 ? machine->cpus_of(record.role) : rest;
    }
    const Status status = threads_.emplace_back().start(
        settings, [](void* loop) { static_cast<ThreadLoop*>(loop)->run(); }, &loops_[i]);
    if (!status) {
      return Status::error(status.code(), "thread %s (role %s): %s", record.name, name_of(record.role),
                           status.cause());
    }
    application.thread_states[i].thread_id.store(threads_.back().id());
  }
  lives_ = true;
  ThreadSettings settings;
  settings.name = "lifecycle";
  return threads_.emplace_back().start(
      settings, [](void* executive) { static_cast<Executive*>(executive)->live(); }, this);
}

Status Executive::start_observer() {
#ifndef FLEXRF_SANITIZER  // a sanitizer's frames are larger
  // Whatever starts a thread without saying how: of the usual 8 MiB of stack all would be locked, and a main
  // thread that somebody made real-time would have real-time children.
  pthread_attr_t attributes;
  sched_param ordinary{};
  pthread_attr_init(&attributes);
  pthread_attr_setstacksize(&attributes, observer_stack_size);
  pthread_attr_setinheritsched(&attributes, PTHREAD_EXPLICIT_SCHED);
  pthread_attr_setschedpolicy(&attributes, SCHED_OTHER);
  pthread_attr_setschedparam(&attributes, &ordinary);
  const int error = pthread_setattr_default_np(&attributes);
  pthread_attr_destroy(&attributes);
  if (error != 0) {
    return Status::error(StatusCode::internal, "threads of the observer: %s", std::strerror(error));
  }
#endif
  return observer_->start();
}

void Executive::live() {
  if (const Status status = lifecycle_.start_all(); status) {
    begin_running();
  } else {
    log_error(cell_.application().name, "not started: {}", status.cause());
    cell_.control().set_cause(EndCause::fault);
    cell_.control().note_fault();
    cell_.control().rise_to(Mode::safe);
  }
  while (lives_.load(std::memory_order_acquire)) {
    if (lifecycle_.has_jobs()) lifecycle_.run_jobs();
    if (cell_.control().mode() == Mode::running) {
      lifecycle_.restart_by_policy();
      lifecycle_.seek_missing();
    }
    nanosleep(&lifecycle_pause, nullptr);
  }
  lifecycle_.close();
  lifecycle_.stop_all();
}

void Executive::supervise(RunSummary& summary) {
  Control& control = cell_.control();
  Supervision supervision(cell_, lifecycle_, true);
  HeartbeatWatch heartbeats(cell_);
  ServiceManager manager(cell_.application().name, ServiceManagerAddress::of_environment(),
                         cell_.heartbeat());
  const sigset_t awaited = signals::supervised_set();
  const timespec interval{0, supervision_interval.count()};
  Standstill standstill(cell_, no_index);
  Time running_since{};
  Time looked = MonotonicClock::now();
  while (control.mode() != Mode::ended) {
    siginfo_t sent;
    const int signal = sigtimedwait(&awaited, &sent, &interval);
    const Time now = MonotonicClock::now();
    standstill.judge(looked, now);
    control.note_look(now);
    if (signal > 0) obey(sent, summary);
    looked = now;
    if (const int replaced = last_gasp::put_handlers_back(); replaced != 0)
      log_error(
          replaced_handler_, cell_.application().name,
          "{} was given to another handler, as by a library of a unit; the one that makes devices safe is "
          "back. Keep the library from handling it",
          StaticText{signals::name_of(replaced)});
    if (running_since == Time{} && control.mode() >= Mode::running) {
      running_since = now;
      summary.start_time = now - began_;
    }
    permit_.observe(now);
    supervision.observe(now);
    heartbeats.observe(now, supervision.is_stuck());
    manager.observe(now, control);
    output_.observe();
  }
  summary.had_fault = summary.had_fault || supervision.had_fault();
  summary.cut_short = supervision.was_cut_short();
  if (running_since != Time{}) summary.run_time = MonotonicClock::now() - running_since;
  if (supervision.is_stuck()) {
    summary.stuck = true;
    return;
  }
  join_threads();
  // In a step that had begun before.
  summary.had_fault = summary.had_fault || control.faults() > 0;
}

void Executive::obey(const siginfo_t& sent, RunSummary& summary) noexcept {
  Control& control = cell_.control();
  const int signal = sent.si_signo;
  switch (signals::use_of(signal)) {
    case signals::Use::end:
      summary.signal = signal;
      asked_to_end_ = true;
      control.set_cause(EndCause::signal);
      // Asked twice, or by Ctrl-\, whoever asks does not want to wait for units to come to rest.
      control.rise_to(signal == SIGQUIT || control.mode() == Mode::stopping ? Mode::safe : Mode::stopping);
      return;
    case signals::Use::stop:
      return JobControl(cell_).stop(signal);
    case signals::Use::crash:
    case signals::Use::none:
      log_warning(useless_signal_, cell_.application().name,
                  "{} from process {} has no meaning here and changes nothing; SIGTERM ends the application",
                  StaticText{signals::name_of(signal)}, sent.si_pid);
      return;
  }
}

void Executive::join_threads() noexcept {
  const bool lifecycle_runs = lives_.load();
  for (std::size_t i = 0; i + (lifecycle_runs ? 1 : 0) < threads_.size(); ++i) threads_[i].join();
  lifecycle_.threads_ended();
  lives_.store(false, std::memory_order_release);
  if (lifecycle_runs) threads_.back().join();
}

}  // namespace flexrf
