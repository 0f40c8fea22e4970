#include "config-gen/check/checks.hpp"
#include "config-gen/model/ports.hpp"
#include "config-gen/model/target.hpp"
#include "config-gen/model/words.hpp"

namespace flexrf::config_gen {

namespace {

void check_all(Model& model, Diagnostics& diagnostics) {
  check_class_names(model, diagnostics);
  if (!model.application) return;
  check_inputs(model, diagnostics);
  check_slots(model, diagnostics);
  check_queues(model, diagnostics);
  check_devices(model, diagnostics);
  check_options(model, diagnostics);
  check_threads(model, diagnostics);
  check_triggers(model, diagnostics);
  check_schedule(model, diagnostics);
  check_cycles(model, diagnostics);
  check_memory(model, diagnostics);
}

}  // namespace

void check(Model& model, Diagnostics& diagnostics) {
  if (diagnostics.gave_up()) return;  // the model is not complete
  try {
    check_all(model, diagnostics);
  } catch (const GivenUp&) {
    // They are in `diagnostics`.
  }
}

std::string describe(const Model& model, const Writer& writer) {
  return "output " + quote(ports_of(model, writer.owner).outputs[writer.port].name) + " of " +
         describe(model, writer.owner);
}

std::string describe(const Model& model, const InputReference& input) {
  return "input " + quote(ports_of(model, input.owner).inputs[input.port].name) + " of " +
         describe(model, input.owner);
}

Position declared_at(const Model& model, const Writer& writer) {
  return ports_of(model, writer.owner).outputs[writer.port].type_position;
}

Nanoseconds interval_of(const Thread& thread) {
  if (const auto* period = std::get_if<PeriodTrigger>(&thread.trigger)) return period->period;
  if (const auto* slots = std::get_if<SlotsTrigger>(&thread.trigger)) return slots->min_interval.value_or(0);
  if (const auto* device = std::get_if<DeviceTrigger>(&thread.trigger))
    return device->min_interval.value_or(0);
  if (const auto* backoff = std::get_if<BackoffTrigger>(&thread.trigger)) return backoff->shortest;
  return 0;
}

InInstance::InInstance(Diagnostics& diagnostics, const Model& model, const std::string& name)
    : diagnostics_(diagnostics) {
  const std::size_t dot = name.rfind('.');
  if (dot == std::string::npos) return;
  for (const GroupInstance& group : model.groups) {
    if (name.compare(0, dot, group.name) != 0) continue;
    diagnostics.enter(group.name, group.position);
    active_ = true;
    return;
  }
}

InInstance::~InInstance() {
  if (active_) diagnostics_.leave();
}

}  // namespace flexrf::config_gen
