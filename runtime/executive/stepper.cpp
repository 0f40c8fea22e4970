#include "runtime/executive/stepper.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>

#include "runtime/log/log.hpp"
#include "runtime/realtime/last_gasp.hpp"

namespace flexrf {
namespace {

/// Until somebody is told that an actuator does not confirm that it is safe.
constexpr Duration longest_unconfirmed = std::chrono::seconds{1};

/// Its first fault stays.
void blame(Component& component, const Status& cause) noexcept {
  if (component.fault().is_ok()) component.set_fault(cause);
}

/// Counters with one writer: a load and a store, no read-modify-write.
template <class Counter, class Value>
void add(Counter& counter, Value value) noexcept {
  counter.store(counter.load(std::memory_order_relaxed) + value, std::memory_order_relaxed);
}

[[gnu::noinline]] void tell_restraint(const char* name, Component& component, SharedRestraint& shared,
                                      Time now) noexcept {
  const Restraint restraint = component.take_restraint();
  if (shared.note(restraint, now)) log_warning(name, "{}", RestraintText(restraint).text);
}

/// After each step or send. Nearly always there is none and was none, which costs two loads.
void note_restraint(const char* name, Component& component, SharedRestraint& shared, Time now) noexcept {
  if (component.is_restrained() || shared.lasts_on()) [[unlikely]]
    tell_restraint(name, component, shared, now);
}

}  // namespace

Stepper::Stepper(Cell& cell, std::uint16_t thread)
    : cell_(&cell),
      application_(&cell.application()),
      record_(&application_->threads[thread]),
      state_(&application_->thread_states[thread]),
      context_(record_->context),
      budgets_(*application_, *record_),
      receives_(!record_->devices.empty()) {
  state_->inhibited_for.store(0, std::memory_order_relaxed);
}

bool Stepper::owns_device(std::uint16_t device) const noexcept {
  return application_->device_states[device].is_owned_by_thread();
}

// ---- between steps

void Stepper::serve(Time now) noexcept {
  if (state_->asked_back.load(std::memory_order_acquire)) give_back();
  // Before the requests: a hold is judged by the permission as it is now.
  follow_motion_permission(now);
  RequestQueue& queue = cell_->requests(static_cast<std::uint16_t>(record_ - application_->threads.data()));
  if (!queue.has_any()) return;
  ParameterRequest request;
  // At most one queue's worth: who fills it faster than this must not hold up the step.
  for (std::uint32_t i = 0; i < RequestQueue::capacity && queue.pop(request); ++i) apply(request, now);
}

void Stepper::give_back() noexcept {
  state_->asked_back.store(false, std::memory_order_relaxed);
  const auto let_go = [](ComponentState& state) {
    Ownership asked = Ownership::asked_back;
    state.ownership.compare_exchange_strong(asked, Ownership::lifecycle, std::memory_order_acq_rel);
  };
  for (const std::uint16_t unit : record_->units) let_go(application_->unit_states[unit]);
  for (const std::uint16_t device : record_->devices) let_go(application_->device_states[device]);
}

void Stepper::apply(const ParameterRequest& request, Time now) noexcept {
  const ComponentState& state = application_->component_state(request.component);
  if (!state.is_owned_by_thread()) {
    const Status cause = Status::error(StatusCode::not_permitted, "%s is %s; initialise it first",
                                       cell_->component_name(request.component), name_of(state.life.load()));
    cell_->answer(request.requester,
                  ParameterAnswer::refused(request, cell_->parameters(request.component).sequence(),
                                           no_parameter, cause.cause()));
    return;
  }
  if (request.kind == RequestKind::activate || request.kind == RequestKind::clone ||
      request.kind == RequestKind::retire) {
    apply_to_member(request, request.component, now);
    return;
  }
  if (request.kind == RequestKind::hold && !may_move_) {
    cell_->answer(request.requester,
                  ParameterAnswer::unmet(request, cell_->parameters(request.component).sequence(),
                                         no_parameter, "motion is inhibited; give Start first"));
    return;
  }
  RuntimeParameters& parameters = cell_->parameters(request.component);
  if (const char* const reason = parameters.unmet_need(request, may_move_); reason != nullptr) {
    cell_->answer(request.requester, ParameterAnswer::unmet(request, parameters.sequence(),
                                                            request.changes[0].parameter, reason));
    return;
  }
  cell_->answer(request.requester, parameters.apply(request, now));
}

void Stepper::apply_to_member(const ParameterRequest& request, std::uint16_t unit, Time now) noexcept {
  RuntimeParameters& parameters = cell_->parameters(unit);
  const auto refuse = [&](const char* reason) {
    cell_->answer(request.requester,
                  ParameterAnswer::refused(request, parameters.sequence(), no_parameter, reason));
  };
  const ComponentRecord& record = application_->component(unit);
  if (record.population == no_index) return refuse("it is not a member of a population");
  UnitState& member = application_->unit_states[unit];
  const bool active = member.active.load(std::memory_order_relaxed);
  if (request.kind == RequestKind::retire) {
    if (!active) return refuse("this member is not active");
    parameters.end_all_leases(now);
    member.active.store(false, std::memory_order_release);
    member.idle.store(true, std::memory_order_relaxed);
    cell_->set_writer_state(unit, WriterState::retired);
    cell_->audit().note(request.who, "retired", record.name);
    cell_->answer(request.requester, ParameterAnswer::accepted(request, parameters.sequence()));
    return;
  }
  if (active) return refuse("this member is active already");
  const void* base = nullptr;
  if (request.kind == RequestKind::clone) {
    const std::uint16_t source = request.source;
    if (source >= application_->component_count() ||
        application_->component(source).population != record.population) {
      return refuse("a member can only be cloned from one of its own population");
    }
    if (application_->component(source).thread != record.thread)
      return refuse("the member to copy lives in another thread");
    base = cell_->parameters(source).values();
  }
  const ParameterAnswer answer =
      parameters.has_any() ? parameters.apply(request, now, base) : ParameterAnswer::accepted(request, 0);
  if (answer.kind == AnswerKind::accepted) {
    member.unit->reset();
    const Status own = parameters.take_own_changes(now);
    if (!own) blame(*member.unit, own);
    member.active.store(true, std::memory_order_release);
    cell_->set_writer_state(unit, WriterState::running);
    cell_->audit().note(request.who, request.kind == RequestKind::clone ? "cloned into" : "activated",
                        record.name);
  }
  cell_->answer(request.requester, answer);
}

void Stepper::follow_motion_permission(Time now) noexcept {
  const Control& control = cell_->control();
  const std::uint32_t withdrawals = control.withdrawals();
  const bool could_move = may_move_;
  // A permission that was withdrawn counts again only when each unit and device here has had a cycle without.
  may_move_ = control.may_move() && control.mode() < Mode::safe &&
              state_->inhibited_for.load(std::memory_order_relaxed) == withdrawals;
  follow_safe_state();
  // Every time, not only when it changes: the lifecycle thread has judged by itself when it initialised a
  // device, and may have seen the moment before.
  for (const std::uint16_t device : record_->devices) {
    DeviceState& state = application_->device_states[device];
    if (!cell_->driver(device).actuates || state.life.load(std::memory_order_relaxed) == Life::fault)
      continue;
    const bool inhibited = !may_move_ || state.make_safe.load(std::memory_order_relaxed);
    if (state.device->is_inhibited() != inhibited) state.device->set_inhibited(inhibited);
  }
  // A permission that was withdrawn and given again between two looks was withdrawn.
  if (withdrawals == withdrawals_ && (may_move_ || !could_move)) return;
  withdrawals_ = withdrawals;
  // What a person holds ends with the permission to move, and only a new press begins it again.
  for (const std::uint16_t unit : record_->units) {
    if (application_->unit_states[unit].is_owned_by_thread()) cell_->parameters(unit).end_all_leases(now);
  }
  for (const std::uint16_t device : record_->devices) {
    if (owns_device(device)) cell_->parameters(application_->devices[device].index).end_all_leases(now);
  }
}

/// An emergency stop that begins, and one that was cleared: what was safe before counts no more.
void Stepper::follow_safe_state() noexcept {
  const bool latched = cell_->control().safe_state_latched();
  if (latched == safe_state_) return;
  safe_state_ = latched;
  for (const std::uint16_t device : record_->devices) {
    DeviceState& state = application_->device_states[device];
    if (!state.make_safe.load(std::memory_order_relaxed) && cell_->control().mode() < Mode::safe)
      state.safe.store(false, std::memory_order_release);
  }
}

/// After the devices received: one that guards motion and does not permit it has this thread act in this very
/// cycle, and all others woken. While it is not this thread's, or in fault, nobody knows whether it permits.
void Stepper::follow_demands(Time now) noexcept {
  Control& control = cell_->control();
  for (const std::uint16_t index : record_->devices) {
    DeviceState& state = application_->device_states[index];
    const bool owned = owns_device(index);
    const bool demands = state.guards.load(std::memory_order_acquire) &&
                         (!owned || state.life.load(std::memory_order_relaxed) == Life::fault ||
                          state.device->demands_safe_state());
    if (demands != state.demands) {
      state.demands = demands;
      if (demands) {
        control.begin_demand();
      } else {
        control.end_demand();
      }
    }
    // Before it was initialised for the first time it only holds up the Start.
    const Mode mode = control.mode();
    if (!demands || control.safe_state_latched() || mode >= Mode::safe || (!owned && mode < Mode::running))
      continue;
    control.latch_safe_state();
    char who[longest_who];
    std::snprintf(who, sizeof(who), "emergency stop (%s)", application_->devices[index].name);
    cell_->audit().note(who, "stopped motion", {}, AuditRecord::Kind::stop);
    log_warning(application_->devices[index].name,
                "emergency stop: every actuator is made safe; release it, clear the stop and give Start");
  }
  if (!safe_state_ && control.safe_state_latched()) {
    follow_motion_permission(now);
    tick_.motion_inhibited = true;
  }
}

// ---- one release

Time Stepper::run(const Release& release) noexcept {
  begin(release);
  receive(release.now);
  Time now = release.now;
  StepTrace* const trace = asked_trace(now);
  budgets_.begin();
  for (std::size_t place = 0; place < record_->units.size(); ++place) {
    if (!step(place, now)) continue;
    // One reading of the clock ends this step's measurement and stamps the next step.
    const Time ended = MonotonicClock::now();
    UnitState& unit = application_->unit_states[record_->units[place]];
    const std::int64_t took = (ended - now).count();
    add(unit.execution_total, took);
    if (took > unit.execution_maximum.load(std::memory_order_relaxed)) {
      unit.execution_maximum.store(took, std::memory_order_relaxed);
    }
    if (trace != nullptr) [[unlikely]]
      trace->note({record_->units[place], now, Duration{took}});
    if (now >= cell_->control().judged_from()) budgets_.note(record_->units[place], Duration{took}, ended);
    now = ended;
  }
  send(now);
  finish();
  return receives_ ? MonotonicClock::now() : now;
}

void Stepper::finish() noexcept {
  if (inhibited_) state_->inhibited_for.store(*inhibited_, std::memory_order_release);
  state_->step_began.store(0, std::memory_order_release);
}

/// Null while nobody asks.
StepTrace* Stepper::asked_trace(Time now) const noexcept {
  StepTraces* const traces = cell_->step_traces();
  if (traces == nullptr) return nullptr;
  return traces->asked(static_cast<std::size_t>(record_ - application_->threads.data()), now);
}

void Stepper::begin(const Release& release) noexcept {
  const Control& control = cell_->control();
  const Mode mode = control.mode();
  tick_.nominal = release.nominal;
  tick_.lateness = release.now - release.nominal;
  tick_.fired = release.fired;
  tick_.timed_out = release.timed_out;
  tick_.finishing = mode == Mode::finishing;
  stopping_ = mode >= Mode::stopping;
  tick_.motion_inhibited = !may_move_;
  tick_.permitted_since = control.started_at();
  inhibited_ = may_move_ ? std::nullopt : std::optional(withdrawals_);
  making_safe_ = mode >= Mode::safe;
  add(state_->cycles, std::uint64_t{1});
  state_->step_began.store(nanoseconds(release.now), std::memory_order_release);
}

/// Its ports take what is newest now: a view that somebody else of this thread had ends.
void Stepper::begin_step(Time now) noexcept {
  context_->now = now;
  ++context_->step;
}

void Stepper::receive(Time now) noexcept {
  if (!receives_) return;
  tick_.now = now;
  for (const std::uint16_t index : record_->devices) {
    if (!owns_device(index)) continue;
    Device& device = *application_->device_states[index].device;
    begin_step(now);
    note_stepped(application_->devices[index].name);
    cell_->parameters(application_->devices[index].index).before_step(now);
    device.receive(tick_);
    // What comes to its end before all is initialised is noticed afterwards: until then nothing can be
    // finished.
    if (device.is_closed() && cell_->control().mode() >= Mode::running) {
      cell_->control().set_cause(EndCause::end_of_input);
      cell_->control().rise_to(Mode::finishing);
    }
    check_device(index);
  }
  follow_demands(now);
}

bool Stepper::step(std::size_t place, Time now) noexcept {
  const std::uint16_t index = record_->units[place];
  UnitState& state = application_->unit_states[index];
  if (!state.is_owned_by_thread() || making_safe_ || !state.active.load(std::memory_order_relaxed)) {
    return false;
  }
  const UnitRecord& record = application_->units[index];
  Unit& unit = *state.unit;
  RuntimeParameters& parameters = cell_->parameters(index);
  tick_.now = now;
  tick_.stop_requested = stopping_ || state.stop_requested.load(std::memory_order_relaxed);
  tick_.number = state.steps.load(std::memory_order_relaxed);
  tick_.elapsed = tick_.number == 0 ? Duration{} : now - state.stepped_at;
  state.stepped_at = now;
  begin_step(now);
  note_stepped(record.name);
  parameters.before_step(now);
  try {
    unit.step(tick_);
  } catch (const std::exception& error) {
    unit.set_fault(Status::error(StatusCode::internal, "an exception left step(): %s", error.what()));
  } catch (...) {
    unit.set_fault(Status::error(StatusCode::internal, "an exception of unknown type left step()"));
  }
  if (record.feedback_slot != nullptr) {
    publish_feedback(record.feedback_slot, record.type->feedback, unit.parameter_memory().feedback, now);
  }
  if (const Status own = parameters.after_step(now); !own) [[unlikely]]
    blame(unit, own);
  add(state.steps, std::uint64_t{1});
  note_restraint(record.name, unit, state.restraint, now);
  if (!unit.fault().is_ok()) [[unlikely]] {
    fault_unit(index, unit.fault());
  } else {
    state.idle.store(unit.is_idle(), std::memory_order_release);
  }
  return true;
}

/// For the crash's message, and for whoever finds that this thread hangs.
void Stepper::note_stepped(const char* component) noexcept {
  last_gasp::set_stepped(component);
  state_->stepped.store(component, std::memory_order_relaxed);
}

void Stepper::send(Time now) noexcept {
  if (!receives_) return;
  tick_.now = now;
  context_->now = now;
  make_safe();
  for (std::size_t place = record_->devices.size(); place-- > 0;) {
    const std::uint16_t index = record_->devices[place];
    if (!owns_device(index)) continue;
    DeviceState& state = application_->device_states[index];
    begin_step(now);
    note_stepped(application_->devices[index].name);
    state.device->send(tick_);
    note_restraint(application_->devices[index].name, *state.device, state.restraint, now);
    if (const Status own = cell_->parameters(application_->devices[index].index).after_step(now); !own)
        [[unlikely]]
      blame(*state.device, own);
    check_device(index);
    if (SlotControl* slot = application_->devices[index].feedback_slot; slot != nullptr) {
      publish_feedback(slot, cell_->driver(index).type->feedback, state.device->parameter_memory().feedback,
                       now);
    }
  }
  note_stepped(nullptr);
}

void Stepper::publish_feedback(SlotControl* slot, const ParameterBlock& block, const void* values,
                               Time now) noexcept {
  // A device's slot may be another driver's: this one has nothing to publish.
  if (values == nullptr || block.type == nullptr) return;
  const std::uint8_t buffer = slot->loan();
  if (buffer == SlotControl::none) return;
  std::memcpy(slot->payload(buffer), values, block.type->size);
  slot->publish(buffer, now);
}

// ---- faults and the safe state

/// Children before buses: the reverse of the order in which they receive.
void Stepper::make_safe() noexcept {
  for (std::size_t place = record_->devices.size(); place-- > 0;) {
    const std::uint16_t index = record_->devices[place];
    DeviceState& state = application_->device_states[index];
    if (!is_to_be_safe(index) || state.safe.load(std::memory_order_relaxed) || !owns_device(index)) continue;
    if (cell_->driver(index).actuates) state.device->set_inhibited(true);
    begin_step(context_->now);
    const bool is_safe = state.device->make_safe();
    if (is_safe) state.safe.store(true, std::memory_order_release);
    if (cell_->driver(index).actuates) note_confirmation(index, is_safe);
  }
}

/// make_safe() of an actuator is repeated until it returns true, also after the stop was cleared.
void Stepper::note_confirmation(std::uint16_t index, bool is_safe) noexcept {
  DeviceState& state = application_->device_states[index];
  const bool is_first = !state.unconfirmed.load(std::memory_order_relaxed);
  state.unconfirmed.store(!is_safe, std::memory_order_release);
  if (is_safe) return;
  if (is_first) state.unconfirmed_since = context_->now;
  if (state.unconfirmed_since == Time{} || context_->now - state.unconfirmed_since < longest_unconfirmed)
    return;
  state.unconfirmed_since = Time{};
  log_error(
      application_->devices[index].name,
      "make_safe() was called {} ms ago and is not confirmed: it may still move. The call is repeated in "
      "each cycle; Start is refused until it is confirmed or the device is initialised anew",
      longest_unconfirmed / std::chrono::milliseconds{1});
}

bool Stepper::is_to_be_safe(std::uint16_t device) const noexcept {
  const DeviceState& state = application_->device_states[device];
  return making_safe_ || state.make_safe.load(std::memory_order_relaxed) ||
         state.unconfirmed.load(std::memory_order_relaxed) || (safe_state_ && cell_->driver(device).actuates);
}

bool Stepper::is_safe() const noexcept {
  return std::all_of(record_->devices.begin(), record_->devices.end(), [this](std::uint16_t index) {
    return !owns_device(index) || application_->device_states[index].safe.load(std::memory_order_relaxed);
  });
}

bool Stepper::needs_attention() const noexcept {
  const Mode mode = cell_->control().mode();
  if (mode >= Mode::safe) return !is_safe();
  if (mode == Mode::stopping) return true;
  if (state_->inhibited_for.load(std::memory_order_relaxed) != cell_->control().withdrawals()) return true;
  for (const std::uint16_t unit : record_->units) {
    const UnitState& state = application_->unit_states[unit];
    if (state.stop_requested.load(std::memory_order_relaxed) &&
        state.ownership.load(std::memory_order_relaxed) == Ownership::thread) {
      return true;
    }
  }
  return std::any_of(record_->devices.begin(), record_->devices.end(), [this](std::uint16_t index) {
    const DeviceState& state = application_->device_states[index];
    return is_to_be_safe(index) && !state.safe.load(std::memory_order_relaxed) && owns_device(index);
  });
}

void Stepper::check_device(std::uint16_t index) noexcept {
  DeviceState& state = application_->device_states[index];
  if (state.device->fault().is_ok() || state.life.load(std::memory_order_relaxed) == Life::fault) return;
  const Status cause = state.device->fault();
  cell_->control().note_fault();
  cell_->set_fault(application_->devices[index].index, cause);
  state.make_safe.store(true, std::memory_order_relaxed);
  state.device->set_inhibited(true);
  log_error(application_->devices[index].name, "fault: {}", cause.cause());
}

void Stepper::fault_unit(std::uint16_t index, const Status& cause) noexcept {
  UnitState& state = application_->unit_states[index];
  // Counted first: who sees the fault, and ends the application for it, finds it counted.
  cell_->control().note_fault();
  cell_->set_fault(index, cause);
  state.idle.store(true, std::memory_order_release);
  cell_->parameters(index).end_all_leases(context_->now);
  // Nobody commands its devices any more: they are brought to rest by their own means.
  for (const std::uint16_t device : cell_->devices_of(index))
    application_->device_states[device].make_safe.store(true, std::memory_order_relaxed);
  log_error(application_->units[index].name, "fault: {}", cause.cause());
  // The last that is done: from here on the lifecycle thread may destroy the unit, and with it the cause.
  state.ownership.store(Ownership::lifecycle, std::memory_order_release);
}

void Stepper::fault_all(const Status& cause) noexcept {
  for (const std::uint16_t unit : record_->units) {
    if (application_->unit_states[unit].is_owned_by_thread()) fault_unit(unit, cause);
  }
}

}  // namespace flexrf
