#include "runtime/face/statistics.hpp"

#include <utility>

#include "base/quantity_text.hpp"
#include "runtime/executive/schedulability.hpp"

namespace flexrf {

ComponentFigures Statistics::component(ComponentIndex component) const noexcept {
  const ComponentState& state = cell_->application().component_state(component);
  ComponentFigures figures{};
  figures.record = &cell_->application().component(component);
  figures.type = state.type;
  figures.driver = cell_->driver_name(component);
  if (figures.record->population != no_index)
    figures.population = cell_->application().populations[figures.record->population].name;
  figures.life = state.life.load(std::memory_order_acquire);
  if (figures.life == Life::fault || figures.life == Life::waiting) figures.fault = state.fault.read();
  figures.active = state.active.load(std::memory_order_relaxed);
  figures.restraint = state.restraint.read();
  figures.restraints = state.restraint.count();
  figures.steps = state.steps.load(std::memory_order_relaxed);
  if (figures.steps > 0) {
    figures.execution_mean = Duration{state.execution_total.load(std::memory_order_relaxed) /
                                      static_cast<std::int64_t>(figures.steps)};
  }
  figures.budget_overruns = state.budget_overruns.load(std::memory_order_relaxed);
  figures.execution_maximum = Duration{state.execution_maximum.load(std::memory_order_relaxed)};
  return figures;
}

DeviceFigures Statistics::device(std::size_t device) const noexcept {
  const Application& application = cell_->application();
  const DeviceRecord& record = application.devices[device];
  const DriverRecord& driver = cell_->driver(static_cast<std::uint16_t>(device));
  return {component(record.index),
          &record,
          &driver,
          record.unit == no_index ? "" : application.units[record.unit].name,
          record.bus == no_index ? "" : application.devices[record.bus].name,
          application.threads[record.thread].name,
          driver.actuates && application.device_states[device].device->is_inhibited()};
}

ThreadFigures Statistics::thread(std::size_t thread) const noexcept {
  const ThreadState& state = cell_->application().thread_states[thread];
  return {&cell_->application().threads[thread],
          state.thread_id.load(std::memory_order_relaxed),
          Time{Duration{state.step_began.load()}},
          state.cycles.load(std::memory_order_relaxed),
          state.overruns.load(std::memory_order_relaxed),
          state.skipped.load(std::memory_order_relaxed),
          Duration{state.skipped_time.load(std::memory_order_relaxed)},
          Duration{state.longest_standstill.load(std::memory_order_relaxed)},
          state.allocations.load(std::memory_order_relaxed),
          &state.lateness,
          &state.execution,
          Duration{state.backoff_mean.load(std::memory_order_relaxed)},
          Duration{state.backoff_spread.load(std::memory_order_relaxed)},
          state.minor_faults.load(std::memory_order_relaxed),
          state.major_faults.load(std::memory_order_relaxed),
          state.voluntary_switches.load(std::memory_order_relaxed),
          state.involuntary_switches.load(std::memory_order_relaxed)};
}

SlotFigures Statistics::slot(std::size_t slot) const noexcept {
  const SlotRecord& record = cell_->application().slots[slot];
  return {static_cast<std::uint16_t>(slot), &record, record.control->type(), record.control->published(),
          readers_[slot]};
}

QueueFigures Statistics::queue(std::size_t queue) const noexcept {
  QueueFigures figures{&cell_->application().queues[queue], 0};
  if (const QueueSource* const source = figures.source(); source != nullptr) figures.fill = source->fill();
  return figures;
}

std::vector<std::optional<Duration>> response_estimates(const Cell& cell, bool realtime) {
  const Application& application = cell.application();
  std::vector<std::optional<Duration>> responses(application.threads.size());
  if (!realtime) return responses;
  const Result<MachineFile> machine = MachineFile::of_this_machine();
  if (!machine) return responses;
  const auto estimates = estimate_response_times(application, *machine);
  for (std::size_t i = 0; i < responses.size(); ++i) {
    if (estimates[i]) responses[i] = estimates[i]->result.response;
  }
  return responses;
}

std::int64_t FaultPlaces::extent(std::size_t place) const noexcept {
  const Application& application = cell_->application();
  if (place < thread(0))
    return application.component_state(static_cast<ComponentIndex>(place)).is_in_fault() ? 1 : 0;
  if (place < process())
    return application.thread_states[place - thread(0)].longest_standstill.load(std::memory_order_relaxed);
  return cell_->control().longest_standstill().count();
}

FaultPlaces::Fault FaultPlaces::at(std::size_t place) const {
  const Application& application = cell_->application();
  if (place < thread(0)) {
    const auto component = static_cast<ComponentIndex>(place);
    const ComponentRecord& record = application.component(component);
    return {record.kind, record.name, record.name,
            application.component_state(component).fault.read().cause()};
  }
  const std::string cause = "stood still for " + duration_text(Duration{extent(place)});
  if (place == process())
    return {"process", application.name, std::string{"process "} + application.name, cause};
  return of_thread(place - thread(0), cause);
}

FaultPlaces::Fault FaultPlaces::hanging(std::size_t thread) const {
  return of_thread(thread, "its step does not return");
}

FaultPlaces::Fault FaultPlaces::of_thread(std::size_t thread, std::string cause) const {
  const char* const name = cell_->application().threads[thread].name;
  return {"thread", name, std::string{"thread "} + name, std::move(cause)};
}

}  // namespace flexrf
