#include "runtime/executive/lifecycle.hpp"

#include <algorithm>
#include <cstring>
#include <ctime>
#include <exception>
#include <string>
#include <string_view>

#include "runtime/executive/supervision.hpp"
#include "runtime/log/log.hpp"

namespace flexrf {
namespace {

/// How long a thread may take to let go of a unit between two of its steps, and the devices of a unit that
/// does not come to rest to become safe: no shorter than a step that does not hang yet.
Duration patience_with(const ThreadRecord& thread) noexcept {
  return std::max(Duration{std::chrono::seconds{1}}, Supervision::hang_timeout(thread));
}
/// How often a device that is not there is looked for.
constexpr Duration seek_interval = std::chrono::milliseconds{500};
/// Steps after which a unit has seen that it is to stop, and has said whether it is idle since.
constexpr std::uint64_t steps_to_notice = 3;

/// What a library throws out of a component's code is its fault, with the library's text.
template <class Call>
Status guarded(Call call) noexcept {
  try {
    return call();
  } catch (const std::exception& error) {
    return Status::error(StatusCode::internal, "exception: %s", error.what());
  } catch (...) {
    return Status::error(StatusCode::internal, "exception of unknown type");
  }
}

/// The device is not there, or does not answer; else somebody has to mend something.
bool is_absence(StatusCode code) noexcept {
  return code == StatusCode::not_found || code == StatusCode::unavailable || code == StatusCode::timeout;
}

void pause() noexcept {
  const timespec millisecond{0, 1'000'000};
  nanosleep(&millisecond, nullptr);
}

}  // namespace

Time Lifecycle::now() const noexcept {
  return MonotonicClock::now();
}

void Lifecycle::begin_operation(const char* component, Duration timeout) noexcept {
  overdue_at_.store(nanoseconds(now() + timeout), std::memory_order_relaxed);
  component_.store(component, std::memory_order_release);
}

void Lifecycle::end_operation() noexcept {
  component_.store(nullptr, std::memory_order_release);
}

Lifecycle::Operation Lifecycle::operation() const noexcept {
  return {component_.load(std::memory_order_acquire),
          Time{Duration{overdue_at_.load(std::memory_order_relaxed)}}};
}

// ---- all

Status Lifecycle::start_all() noexcept {
  for (const ComponentIndex component : cell_->in_starting_order()) {
    const Status status = start(component);
    if (status || cell_->application().component_state(component).life.load() == Life::waiting) continue;
    if (!cell_->application().is_unit(component) && is_absence(status.code()))
      log_info(cell_->component_name(component),
               "with `required = false` in the device's row the application starts without it, and takes it "
               "in when it is there");
    return status;
  }
  return {};
}

void Lifecycle::seek_missing() noexcept {
  if (stamp() < seek_at_) return;
  for (const ComponentIndex component : cell_->in_starting_order()) {
    const ComponentState& state = cell_->application().component_state(component);
    if (state.life.load() != Life::waiting) continue;
    const Status status = start(component);
    if (status) log_info(cell_->component_name(component), "what was missing is there: it runs now");
    if (!state.is_in_fault()) continue;
    cell_->control().note_fault();
    log_error(cell_->component_name(component), "not started: {}", status.cause());
  }
  seek_at_ = stamp() + seek_interval;
}

void Lifecycle::stop_all() noexcept {
  const std::span<const ComponentIndex> order = cell_->in_starting_order();
  for (std::size_t place = order.size(); place-- > 0;) {
    if (const Status status = stop(order[place]); !status)
      log_error(cell_->component_name(order[place]), "cannot be stopped: {}", status.cause());
  }
}

// ---- the handshake

Status Lifecycle::take_back(ComponentIndex component) noexcept {
  const Application& application = cell_->application();
  std::atomic<Ownership>& ownership = application.component_state(component).ownership;
  if (!threads_run_) {
    ownership.store(Ownership::lifecycle, std::memory_order_release);
    return {};
  }
  Ownership expected = Ownership::thread;
  if (!ownership.compare_exchange_strong(expected, Ownership::asked_back, std::memory_order_acq_rel) &&
      expected == Ownership::lifecycle) {
    return {};
  }
  const ComponentRecord& record = application.component(component);
  const ThreadRecord& thread = application.threads[record.thread];
  const Time give_up = now() + patience_with(thread);
  while (ownership.load(std::memory_order_acquire) != Ownership::lifecycle) {
    application.thread_states[record.thread].asked_back.store(true, std::memory_order_release);
    thread.bell->ring();
    if (now() > give_up) {
      return Status::error(StatusCode::timeout, "thread %s does not let go of %s", thread.name, record.name);
    }
    pause();
  }
  return {};
}

// ---- one component

Status Lifecycle::start(ComponentIndex index) noexcept {
  const Application& application = cell_->application();
  const ComponentRecord& record = application.component(index);
  ComponentState& state = application.component_state(index);
  Component& component = cell_->component(index);
  if (state.ownership.load(std::memory_order_acquire) != Ownership::lifecycle) {
    return Status::error(StatusCode::not_permitted, "%s is %s already", record.name,
                         name_of(state.life.load()));
  }
  const bool is_late = state.life.load() == Life::waiting;
  if (const char* const missing = missing_below(index); missing != nullptr)
    return wait_for(index, Status::error(StatusCode::unavailable, "the device %s is not there", missing));
  cell_->note_configuration(index);
  state.stop_requested.store(false, std::memory_order_release);
  if (!application.is_unit(index)) prepare_device(application.device_of(index));
  begin_operation(record.name, record.initialise_timeout);
  component.clear_fault();
  Status status = guarded([&] { return component.initialise(); });
  end_operation();
  if (status && !component.fault().is_ok()) status = component.fault();
  // What the tables or the file say was checked before; accept() may still refuse it.
  const ParameterMemory memory = component.parameter_memory();
  if (status && memory.runtime != nullptr) status = cell_->parameters(index).adopt(memory.runtime, stamp());
  if (!status && may_be_missing(index, is_late || is_absence(status.code()))) return wait_for(index, status);
  if (!status) {
    cell_->set_fault(index, status);
    return Status::error(status.code(), "%s%s: initialise: %s", record.name,
                         cell_->driver_text(index).c_str(), status.cause());
  }
  state.fault.publish({});
  // What comes while others move begins like what comes at power-on.
  if (is_late && cell_->moves_something(index)) cell_->control().require_start();
  begin(index);
  state.life.store(Life::running, std::memory_order_release);
  state.ownership.store(Ownership::thread, std::memory_order_release);
  // Its thread may sleep until something arrives on a device's descriptor that exists only now.
  application.threads[record.thread].bell->ring();
  return {};
}

Status Lifecycle::stop(ComponentIndex index) noexcept {
  const Application& application = cell_->application();
  const ComponentRecord& record = application.component(index);
  ComponentState& state = application.component_state(index);
  if (state.life.load() == Life::created || state.life.load() == Life::stopped) return {};
  if (state.life.load() == Life::waiting) {
    state.life.store(Life::stopped, std::memory_order_release);
    cell_->set_writer_state(index, WriterState::stopped);
    return {};
  }
  if (application.is_unit(index)) {
    bring_to_rest(index);
  } else if (cell_->moves_something(index)) {
    // A unit brings its devices to rest first, which it could not once they are inhibited.
    cell_->control().require_start();
  }
  if (const Status status = take_back(index); !status) return status;
  cell_->set_writer_state(index, WriterState::stopped);
  // Nobody steps it, so nobody would end what is held.
  cell_->parameters(index).end_all_leases(stamp());
  begin_operation(record.name, record.stop_timeout);
  const Status status = guarded([&] {
    cell_->component(index).stop();
    return Status{};
  });
  end_operation();
  if (state.life.load() != Life::fault) state.life.store(Life::stopped, std::memory_order_release);
  state.idle.store(true, std::memory_order_relaxed);
  return status;
}

/// The name of a device that the component stands on, its own or a bus below, and that is waited for; null:
/// there is none.
const char* Lifecycle::missing_below(ComponentIndex index) const noexcept {
  const Application& application = cell_->application();
  for (const std::uint16_t place : cell_->devices_of(index)) {
    std::uint16_t device = application.is_unit(index) ? place : application.devices[place].bus;
    for (; device != no_index; device = application.devices[device].bus) {
      if (application.device_states[device].life.load() == Life::waiting)
        return application.devices[device].name;
    }
  }
  return nullptr;
}

/// One that is waited for is so until it runs: its file may be there before the right to open it.
bool Lifecycle::may_be_missing(ComponentIndex index, bool is_missing) const noexcept {
  const Application& application = cell_->application();
  return is_missing && !application.is_unit(index) &&
         !application.devices[application.device_of(index)].required;
}

/// Says so when the wait begins, and again when the reason is another one.
Status Lifecycle::wait_for(ComponentIndex index, const Status& cause) noexcept {
  const ComponentRecord& record = cell_->application().component(index);
  ComponentState& state = cell_->application().component_state(index);
  const bool waits_already = state.life.load() == Life::waiting;
  const std::string why = cell_->driver_text(index) + ": " + cause.cause();
  if (!waits_already || std::strcmp(state.fault.read().cause(), cause.cause()) != 0)
    log_warning(record.name, "waits and is started later{}", std::string_view(why));
  // What initialise() took before it failed is given back; nothing was begun of what stands on another one.
  if (missing_below(index) == nullptr) {
    begin_operation(record.name, record.stop_timeout);
    static_cast<void>(guarded([&] {
      cell_->component(index).stop();
      return Status{};
    }));
    end_operation();
  }
  state.fault.publish(cause);
  state.life.store(Life::waiting, std::memory_order_release);
  cell_->set_writer_state(index, WriterState::waiting);
  return Status::error(cause.code(), "%s waits%s", record.name, why.c_str());
}

void Lifecycle::begin(ComponentIndex index) noexcept {
  ComponentState& state = cell_->application().component_state(index);
  state.steps.store(0, std::memory_order_relaxed);
  state.idle.store(true, std::memory_order_relaxed);
  for (const std::uint16_t device : cell_->devices_of(index)) {
    cell_->application().device_states[device].make_safe.store(false);
    cell_->application().device_states[device].safe.store(false);
    cell_->application().device_states[device].unconfirmed.store(false);
  }
  cell_->set_writer_state(index, state.active.load() ? WriterState::running : WriterState::retired);
}

void Lifecycle::prepare_device(std::uint16_t index) noexcept {
  DeviceState& state = cell_->application().device_states[index];
  cell_->connect_device(index);
  state.guards.store(state.device->guards_motion(), std::memory_order_release);
  // An actuator is inhibited until its thread has seen a Start.
  state.device->set_inhibited(!cell_->control().may_move());
}

bool Lifecycle::is_at_rest(std::uint16_t index) const noexcept {
  const UnitState& state = cell_->application().unit_states[index];
  return state.idle.load(std::memory_order_acquire) ||
         state.life.load(std::memory_order_acquire) != Life::running;
}

bool Lifecycle::devices_are_safe(std::uint16_t index) const noexcept {
  const std::span<const std::uint16_t> devices = cell_->devices_of(index);
  return std::none_of(devices.begin(), devices.end(), [this](std::uint16_t device) {
    const DeviceState& state = cell_->application().device_states[device];
    return state.make_safe.load(std::memory_order_acquire) && !state.safe.load(std::memory_order_acquire) &&
           state.is_owned_by_thread();
  });
}

/// As the application's own controlled stop, of one unit.
void Lifecycle::bring_to_rest(std::uint16_t index) noexcept {
  const Application& application = cell_->application();
  UnitState& state = application.unit_states[index];
  if (!threads_run_ || !cell_->moves_something(index) || !state.active.load() ||
      state.life.load(std::memory_order_acquire) != Life::running) {
    return;
  }
  const auto wait = [&](Duration most, auto&& is_over) {
    const Time give_up = now() + most;
    // A step may begin at any time; in the safe state none does.
    while (!is_over() && now() < give_up && threads_run_ && cell_->control().mode() < Mode::safe) {
      application.threads[application.units[index].thread].bell->ring();
      pause();
    }
    return is_over();
  };
  const std::uint64_t steps = state.steps.load(std::memory_order_acquire);
  state.stop_requested.store(true, std::memory_order_release);
  const bool rests = wait(application.units[index].stop_timeout, [&] {
    return state.life.load(std::memory_order_acquire) != Life::running ||
           (state.steps.load(std::memory_order_acquire) >= steps + steps_to_notice && is_at_rest(index));
  });
  cell_->control().require_start();
  if (rests || cell_->control().mode() >= Mode::safe) return;
  log_warning(application.units[index].name,
              "not at rest within its stop_timeout; its devices are made safe");
  for (const std::uint16_t device : cell_->devices_of(index))
    application.device_states[device].make_safe.store(true);
  if (!wait(patience_with(application.threads[application.units[index].thread]),
            [&] { return devices_are_safe(index); }))
    log_error(application.units[index].name, "its devices did not become safe in time");
}

Status Lifecycle::restart_unit(std::uint16_t index) noexcept {
  // Set-points are seeded anew; until a person says so, nothing follows them.
  cell_->control().require_start();
  if (const Status status = stop(index); !status) return status;
  if (const Status status = cell_->renew(index); !status) return status;
  return start(index);
}

bool Lifecycle::post(std::function<void()> job) {
  const std::lock_guard lock(jobs_mutex_);
  if (closed_) return false;
  jobs_.push_back(std::move(job));
  has_jobs_.store(true, std::memory_order_release);
  return true;
}

void Lifecycle::close() {
  {
    const std::lock_guard lock(jobs_mutex_);
    closed_ = true;
  }
  run_jobs();
}

void Lifecycle::run_jobs() {
  std::vector<std::function<void()>> jobs;
  {
    const std::lock_guard lock(jobs_mutex_);
    jobs.swap(jobs_);
    has_jobs_.store(false, std::memory_order_release);
  }
  for (const std::function<void()>& job : jobs) job();
}

bool Lifecycle::may_restart(std::uint16_t index) const noexcept {
  const Application& application = cell_->application();
  const RestartPolicy policy = application.units[index].restart;
  if (policy == RestartPolicy::never || (policy == RestartPolicy::once && restarts_[index] > 0)) return false;
  const std::span<const std::uint16_t> devices = cell_->devices_of(index);
  return std::none_of(devices.begin(), devices.end(), [this](std::uint16_t device) {
    return cell_->driver(device).actuates && cell_->is_real(device);
  });
}

void Lifecycle::restart_by_policy() noexcept {
  for (std::size_t i = 0; i < cell_->application().units.size(); ++i) {
    const auto index = static_cast<std::uint16_t>(i);
    UnitState& state = cell_->application().unit_states[i];
    if (!state.is_in_fault() || !may_restart(index) ||
        state.ownership.load(std::memory_order_acquire) != Ownership::lifecycle) {
      continue;
    }
    ++restarts_[i];
    const Status status = restart_unit(index);
    if (status) {
      log_warning(cell_->application().units[i].name, "restarted after a fault; motion needs a new Start");
    } else {
      log_error(cell_->application().units[i].name, "restart failed: {}", status.cause());
    }
  }
}

}  // namespace flexrf
