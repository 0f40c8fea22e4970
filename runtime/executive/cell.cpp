#include "runtime/executive/cell.hpp"

#include <algorithm>
#include <cstring>
#include <numeric>
#include <string>

#include "runtime/core/digest.hpp"
#include "runtime/executive/driver_choice.hpp"
#include "runtime/executive/supervision.hpp"

namespace flexrf {
namespace {

std::vector<Doorbell*> bells_of(const Application& application) {
  std::vector<Doorbell*> bells;
  for (const ThreadRecord& thread : application.threads) bells.push_back(thread.bell);
  return bells;
}

void fill(void* memory, const ParameterBlock& block, const void* initial) noexcept {
  if (memory != nullptr && block.type != nullptr && initial != nullptr) {
    std::memcpy(memory, initial, block.type->size);
  }
}

void carry(SlotControl* slot, const ParameterBlock& block) noexcept {
  if (slot != nullptr && block.type != nullptr) slot->set_type(*block.type);
}

std::vector<std::vector<std::uint16_t>> devices_by_component(const Application& application) {
  std::vector<std::vector<std::uint16_t>> devices(application.component_count());
  for (std::size_t i = 0; i < application.devices.size(); ++i) {
    const DeviceRecord& device = application.devices[i];
    for (const ComponentIndex component : {device.index, device.unit}) {
      if (component != no_index) devices[component].push_back(static_cast<std::uint16_t>(i));
    }
  }
  return devices;
}

std::vector<const PortBinding*> ports_by_component(const Application& application) {
  std::vector<const PortBinding*> ports;
  for (const UnitRecord& unit : application.units) ports.push_back(&unit.binding);
  for (const DeviceRecord& device : application.devices) ports.push_back(&device.binding);
  return ports;
}

std::vector<ComponentIndex> sorted_by_level(const Application& application) {
  std::vector<ComponentIndex> order(application.component_count());
  std::iota(order.begin(), order.end(), ComponentIndex{0});
  std::stable_sort(order.begin(), order.end(), [&application](ComponentIndex a, ComponentIndex b) {
    return application.component(a).level < application.component(b).level;
  });
  return order;
}

std::uint64_t seed_of(std::uint64_t seed, const char* name) noexcept {
  Digest digest{seed};
  digest.add_text(name);
  return digest.value();
}

}  // namespace

Cell::Cell(const Application& application, const Options& options)
    : application_(&application),
      options_(&options),
      bells_(bells_of(application)),
      other_drivers_(application.component_count()),
      devices_of_(devices_by_component(application)),
      ports_(ports_by_component(application)),
      starting_order_(sorted_by_level(application)),
      control_(bells_),
      audit_(std::make_unique<AuditIntake>()),
      parameters_(std::make_unique<RuntimeParameters[]>(application.component_count())),
      requests_(std::make_unique<RequestQueue[]>(application.threads.size())),
      scratch_(std::make_unique<ParameterScratch[]>(application.threads.size())),
      configurations_(std::make_unique<std::vector<std::byte>[]>(application.component_count())),
      configuration_settings_(std::make_unique<ConfigurationSettings[]>(application.component_count())) {
  for (ComponentIndex i = 0; i < application.component_count(); ++i) {
    parameters_[i].set_revision(settings_revision_);
    parameters_[i].set_audit(*audit_, i);
  }
  for (std::size_t i = 0; i < application.threads.size(); ++i)
    requests_[i].set_bell(application.threads[i].bell);
  for (const SlotRecord& slot : application.slots) slot.control->lay_out_items();
}

Cell::~Cell() {
  destroy();
}

Status Cell::choose_drivers() {
  const Result<std::vector<const DriverRecord*>> chosen = flexrf::choose_drivers(*application_, *options_);
  if (!chosen) return chosen.status();
  for (std::size_t i = 0; i < application_->devices.size(); ++i) {
    const DeviceRecord& device = application_->devices[i];
    DeviceState& state = application_->device_states[i];
    const DriverRecord* const driver = (*chosen)[i];
    state.driver = driver;
    state.type = driver->type;
    for (const DriverRecord& other : device.drivers) {
      if (&other != driver) other_drivers_[device.index].push_back(other.name);
    }
  }
  return {};
}

void Cell::narrow_ranges() {
  for (ComponentIndex i = 0; i < component_count(); ++i) {
    const auto is_of_it = [i](const NarrowedRange& range) { return range.component == i; };
    if (std::none_of(application_->ranges.begin(), application_->ranges.end(), is_of_it)) continue;
    const ComponentType*& type = application_->component_state(i).type;
    type = &narrowed_.emplace_back(*type, i, application_->ranges).type();
  }
}

void Cell::stop_motion(std::string_view who) noexcept {
  control_.stop_motion();
  audit_->note(who, "stopped motion", {}, AuditRecord::Kind::stop);
}

void Cell::clear_stop_motion(std::string_view who) noexcept {
  control_.clear_stop_motion();
  audit_->note(who, "cleared the stop", {}, AuditRecord::Kind::clear);
}

Status Cell::start_motion(std::string_view who) noexcept {
  const Status status = control_.start_motion();
  if (status) audit_->note(who, "gave Start");
  return status;
}

/// Shorter than what is taken for a standstill or a hang.
Duration Cell::longest_step_of(const ThreadRecord& thread) const noexcept {
  const Duration hangs = Supervision::hang_timeout(thread);
  const Duration stands = standstill_limit();
  return thread.hang_timeout.count() > 0 || stands <= Duration{} ? hangs : std::min(hangs, stands);
}

Status Cell::construct_device(std::uint16_t index) {
  const DeviceRecord& record = application_->devices[index];
  DeviceState& state = application_->device_states[index];
  const DriverRecord& driver = *state.driver;
  state.device = driver.construct(record.storage);
  *record.instance = state.device;
  state.environment = {seed_of(options_->seed, record.name), options_->virtual_time.has_value(),
                       options_->values(), options_->virtual_time ? nullptr : &heartbeat_};
  if (!options_->virtual_time && record.thread != no_index)
    state.environment.longest_step = longest_step_of(application_->threads[record.thread]);
  state.unconfirmed.store(false, std::memory_order_relaxed);
  state.device->set_name(record.name);
  state.device->set_type_in_force(*state.type);
  state.device->set_environment(&state.environment);
  connect_device(index);
  // They have room for what the largest of its drivers has.
  carry(record.runtime_slot, driver.type->runtime);
  carry(record.feedback_slot, driver.type->feedback);
  const ParameterMemory memory = state.device->parameter_memory();
  fill(memory.configuration, driver.type->configuration, driver.configuration);
  fill(memory.runtime, driver.type->runtime, driver.runtime);
  return parameters_[record.index].connect(*state.device, record.runtime_slot, driver.runtime,
                                           scratch_[record.thread]);
}

Status Cell::construct_unit(std::uint16_t index) {
  const UnitRecord& record = application_->units[index];
  UnitState& state = application_->unit_states[index];
  state.unit = record.construct(record.storage);
  state.unit->set_name(record.name);
  state.unit->set_type_in_force(*state.type);
  state.unit->connect(record.binding);
  const ParameterMemory memory = state.unit->parameter_memory();
  fill(memory.configuration, record.type->configuration, record.configuration);
  fill(memory.runtime, record.type->runtime, record.runtime);
  if (CellAccess* const access = state.unit->cell_access(); access != nullptr) {
    if (const Status status = give_access(index, *access); !status) return status;
  }
  state.life.store(Life::created);
  return parameters_[index].connect(*state.unit, record.runtime_slot, record.runtime,
                                    scratch_[record.thread]);
}

Status Cell::give_access(std::uint16_t unit, CellAccess& access) {
  const UnitRecord& record = application_->units[unit];
  const ThreadRecord& thread = application_->threads[record.thread];
  if (thread.priority > 0) {
    return Status::error(StatusCode::invalid_argument,
                         "unit `%s` has access to the cell, which takes a lock, and is in the real-time "
                         "thread `%s`; give it a thread without a priority",
                         record.name, thread.name);
  }
  for (CellAccess::Post& post : posts_) {
    if (post.unit != unit) continue;
    access.connect(*this, post);
    return {};
  }
  CellAccess::Post& post = posts_.emplace_back();
  post.unit = unit;
  post.requester = add_requester(post.answers);
  if (post.requester == 0) {
    return Status::error(StatusCode::invalid_argument, "unit `%s`: there are %zu requesters already",
                         record.name, max_requesters);
  }
  access.connect(*this, post);
  return {};
}

Status Cell::construct() {
  if (const Status status = choose_drivers(); !status) return status;
  for (std::size_t i = 0; i < application_->units.size(); ++i)
    application_->unit_states[i].type = application_->units[i].type;
  narrow_ranges();
  choose_ports();
  for (const ComponentIndex component : starting_order_) {
    const ComponentRecord& record = application_->component(component);
    application_->component_state(component).active.store(
        record.population == no_index || record.member < application_->populations[record.population].active);
    if (const Status status = construct(component); !status) return status;
  }
  choose_witnesses();
  return {};
}

/// Actuators, and the threads that own one.
void Cell::choose_witnesses() {
  for (std::size_t i = 0; i < application_->threads.size(); ++i) {
    const ThreadRecord& thread = application_->threads[i];
    if (std::any_of(thread.devices.begin(), thread.devices.end(),
                    [this](std::uint16_t device) { return driver(device).actuates; }))
      threads_that_move_.push_back({thread.name, &application_->thread_states[i].inhibited_for});
  }
  for (std::size_t i = 0; i < application_->devices.size(); ++i) {
    if (driver(static_cast<std::uint16_t>(i)).actuates)
      actuators_.push_back({application_->devices[i].name, &application_->device_states[i].unconfirmed});
  }
  control_.use_witnesses(threads_that_move_, actuators_);
}

Status Cell::construct(ComponentIndex component) {
  return application_->is_unit(component) ? construct_unit(component)
                                          : construct_device(application_->device_of(component));
}

void Cell::destroy() noexcept {
  for (std::size_t i = application_->units.size(); i-- > 0;) {
    UnitState& state = application_->unit_states[i];
    if (state.unit != nullptr) std::destroy_at(state.unit);
    state.unit = nullptr;
  }
  for (std::size_t i = application_->devices.size(); i-- > 0;) {
    DeviceState& state = application_->device_states[i];
    if (state.device != nullptr) std::destroy_at(state.device);
    state.device = nullptr;
    *application_->devices[i].instance = nullptr;
  }
}

Status Cell::renew(ComponentIndex index) noexcept {
  if (!application_->is_unit(index)) return {};
  UnitState& state = application_->unit_states[index];
  const ComponentType& type = *application_->units[index].type;
  const auto copy = [](const ParameterBlock& block, const void* from) {
    std::vector<std::byte> bytes(block.type == nullptr || from == nullptr ? 0 : block.type->size);
    if (!bytes.empty()) std::memcpy(bytes.data(), from, bytes.size());
    return bytes;
  };
  const ParameterMemory before = state.unit->parameter_memory();
  const std::vector<std::byte> configuration = copy(type.configuration, before.configuration);
  const std::vector<std::byte> runtime = copy(type.runtime, before.runtime);
  std::destroy_at(state.unit);
  if (const Status status = construct_unit(index); !status) return status;
  const ParameterMemory after = state.unit->parameter_memory();
  if (!configuration.empty()) std::memcpy(after.configuration, configuration.data(), configuration.size());
  if (!runtime.empty()) std::memcpy(after.runtime, runtime.data(), runtime.size());
  return {};
}

const char* Cell::driver_name(ComponentIndex component) const noexcept {
  const DriverRecord* const driver = application_->component_state(component).driver;
  return driver == nullptr ? "" : driver->name;
}

std::string Cell::driver_text(ComponentIndex component) const {
  const std::string driver = driver_name(component);
  return driver.empty() ? driver : " (driver " + driver + ")";
}

void Cell::send(const ParameterRequest& request) noexcept {
  if (request.component >= application_->component_count()) {
    answer(request.requester,
           ParameterAnswer::refused(request, 0, no_parameter, "there is no such component"));
    return;
  }
  if (!requests_[application_->component(request.component).thread].push(request))
    answer(request.requester, ParameterAnswer::busy(request));
}

std::uint16_t Cell::add_requester(AnswerQueue& answers) noexcept {
  if (requester_count_ == max_requesters) return 0;
  requesters_[requester_count_] = &answers;
  return requester_count_++;
}

void Cell::answer(std::uint16_t requester, const ParameterAnswer& answer) noexcept {
  if (requester < requester_count_ && requesters_[requester] != nullptr) requesters_[requester]->push(answer);
}

/// A real driver on a simulated bus reaches nothing real.
bool Cell::is_real(std::uint16_t device) const noexcept {
  if (driver(device).kind != DriverKind::real) return false;
  const std::uint16_t bus = application_->devices[device].bus;
  return bus == no_index || is_real(bus);
}

const char* Cell::real_actuator() const noexcept {
  for (std::size_t i = 0; i < application_->devices.size(); ++i) {
    const auto device = static_cast<std::uint16_t>(i);
    if (driver(device).actuates && is_real(device)) return application_->devices[i].name;
  }
  return nullptr;
}

bool Cell::moves_something(ComponentIndex component) const noexcept {
  const std::span<const std::uint16_t> devices = devices_of(component);
  return std::any_of(devices.begin(), devices.end(),
                     [this](std::uint16_t device) { return driver(device).actuates; });
}

void Cell::set_fault(ComponentIndex component, const Status& cause) noexcept {
  ComponentState& state = application_->component_state(component);
  state.fault.publish(cause);
  state.life.store(Life::fault, std::memory_order_release);
  set_writer_state(component, WriterState::faulted);
}

}  // namespace flexrf
