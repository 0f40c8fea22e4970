// Plans that are often the same, and the application that most tests run.
#include "runtime/executive/tests/fixture.hpp"

namespace flexrf::fixture {

TriggerPlan TriggerPlan::periodic(Duration period, Duration phase) {
  TriggerPlan plan;
  plan.period = period;
  plan.phase = phase;
  return plan;
}

TriggerPlan TriggerPlan::on_slots(std::vector<std::uint16_t> slots, std::vector<std::uint16_t> queues) {
  TriggerPlan plan;
  plan.kind = TriggerKind::slots;
  plan.period = {};
  plan.slots = std::move(slots);
  plan.queues = std::move(queues);
  return plan;
}

TriggerPlan TriggerPlan::on_device(std::uint16_t device) {
  TriggerPlan plan;
  plan.kind = TriggerKind::device;
  plan.period = {};
  plan.device = device;
  return plan;
}

TriggerPlan TriggerPlan::backing_off(std::uint16_t slot, Duration shortest, Duration longest) {
  TriggerPlan plan;
  plan.kind = TriggerKind::backoff;
  plan.period = {};
  plan.slots = {slot};
  plan.shortest = shortest;
  plan.longest = longest;
  return plan;
}

TriggerPlan TriggerPlan::free_running() {
  TriggerPlan plan;
  plan.kind = TriggerKind::free;
  plan.period = {};
  return plan;
}

// ---- the usual application

ProducerAndConsumer::ProducerAndConsumer() {
  add(SlotPlan{.name = "values"});
  add(QueuePlan{.name = "jobs"});
  add(DevicePlan{.name = "actuator", .script = {}});
  UnitPlan producing_unit;
  producing_unit.name = "producer";
  producing_unit.outputs = {values};
  producing_unit.pushes = jobs;
  producing_unit.script.step = [](TestUnit& unit, const Tick& tick) {
    if (tick.finishing) return;
    const Item item{static_cast<std::int64_t>(tick.number), seconds(tick.now.time_since_epoch())};
    unit.outputs[0].publish(item);
    unit.orders.push(item);
    unit.feedback = {tick.number + 1, item.value};
  };
  add(std::move(producing_unit));
  UnitPlan consuming_unit;
  consuming_unit.name = "consumer";
  consuming_unit.inputs = {InputPlan{.slot = values}};
  consuming_unit.pops = jobs;
  consuming_unit.device = actuator;
  consuming_unit.script.step = [](TestUnit& unit, const Tick& tick) {
    while (unit.jobs.pop()) ++unit.memory;
    if (const auto value = unit.inputs[0].latest()) unit.device->command = static_cast<double>(value->number);
    unit.feedback = {tick.number + 1, unit.device->position};
  };
  add(std::move(consuming_unit));
  add(ThreadPlan{.name = "producing",
                 .trigger = TriggerPlan::periodic(std::chrono::milliseconds{1}),
                 .units = {producer},
                 .devices = {}});
  add(ThreadPlan{.name = "consuming",
                 .trigger = TriggerPlan::on_slots({values}, {jobs}),
                 .units = {consumer},
                 .devices = {actuator}});
}

Options in_virtual_time(Duration duration, std::uint64_t seed) {
  Options options = on_the_wall_clock();
  options.virtual_time = duration;
  options.seed = seed;
  options.digest = true;
  return options;
}

Options on_the_wall_clock() {
  Options options;
  options.realtime = false;
  return options;
}

}  // namespace flexrf::fixture
