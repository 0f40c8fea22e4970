#include "runtime/face/statistics.hpp"

#include "base/quantity_text.hpp"
#include "runtime/executive/schedulability.hpp"

namespace flexrf {

ComponentFigures Statistics::component(ComponentIndex component) const noexcept {
  const ComponentState& state = cell_->application().component_state(component);
  ComponentFigures figures{};
  figures.record = &cell_->application().component(component);
  figures.type = state.type;
  figures.driver = cell_->driver_name(component);
  figures.life = state.life.load(std::memory_order_acquire);
  if (figures.life == Life::fault) figures.fault = state.fault.read();
  figures.active = state.active.load(std::memory_order_relaxed);
  figures.restraint = state.restraint.read();
  figures.restraints = state.restraint.count();
  figures.steps = state.steps.load(std::memory_order_relaxed);
  if (figures.steps > 0) {
    figures.execution_mean = Duration{state.execution_total.load(std::memory_order_relaxed) /
                                      static_cast<std::int64_t>(figures.steps)};
  }
  figures.execution_maximum = Duration{state.execution_maximum.load(std::memory_order_relaxed)};
  return figures;
}

ThreadFigures Statistics::thread(std::size_t thread) const noexcept {
  const ThreadState& state = cell_->application().thread_states[thread];
  return {&cell_->application().threads[thread],
          state.cycles.load(std::memory_order_relaxed),
          state.overruns.load(std::memory_order_relaxed),
          state.skipped.load(std::memory_order_relaxed),
          Duration{state.skipped_time.load(std::memory_order_relaxed)},
          Duration{state.longest_standstill.load(std::memory_order_relaxed)},
          state.allocations.load(std::memory_order_relaxed),
          &state.lateness,
          &state.execution,
          state.minor_faults.load(std::memory_order_relaxed),
          state.major_faults.load(std::memory_order_relaxed),
          state.voluntary_switches.load(std::memory_order_relaxed),
          state.involuntary_switches.load(std::memory_order_relaxed)};
}

QueueWriterFigures Statistics::writer(const QueueRecord& queue, std::size_t writer) noexcept {
  return {queue.writers[writer], queue.sinks[writer]->counters()};
}

std::vector<std::optional<Duration>> response_estimates(const Application& application, bool realtime) {
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
    return {record.kind, record.name, application.component_state(component).fault.read().cause()};
  }
  const bool is_process = place == process();
  return {is_process ? "process" : "thread",
          is_process ? application.name : application.threads[place - thread(0)].name,
          "stood still for " + duration_text(Duration{extent(place)})};
}

}  // namespace flexrf
