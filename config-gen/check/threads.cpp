// Threads: whose units they step, with which priority, released by what.
#include <algorithm>

#include "config-gen/check/checks.hpp"
#include "config-gen/model/limits.hpp"
#include "config-gen/model/words.hpp"

namespace flexrf::config_gen {
namespace {

constexpr int highest_below_interrupts = 49;

void check_units_once(const Model& model, Diagnostics& diagnostics) {
  std::vector<const Thread*> first(model.units.size(), nullptr);
  for (const Thread& thread : model.threads) {
    for (const Index index : thread.units) {
      const Unit& unit = model.units[index];
      const InInstance instance(diagnostics, model, unit.name);
      if (first[index] == &thread)
        diagnostics.error(thread.position,
                          "unit " + quote(unit.name) + " is listed twice in thread " + quote(thread.name),
                          "remove one: a unit steps once per release");
      else if (first[index] != nullptr)
        diagnostics.error(thread.position,
                          "unit " + quote(unit.name) + " is in two threads: " + quote(first[index]->name) +
                              " and " + quote(thread.name),
                          "a unit lives in one thread: remove it from one; the other is at " +
                              to_string(first[index]->position));
      else
        first[index] = &thread;
    }
  }
  const bool incomplete = std::any_of(model.threads.begin(), model.threads.end(),
                                      [](const Thread& thread) { return thread.units_unknown; });
  for (Index index = 0; index < model.units.size(); ++index) {
    const Unit& unit = model.units[index];
    if (first[index] != nullptr || unit.partial || incomplete) continue;
    const InInstance instance(diagnostics, model, unit.name);
    diagnostics.error(unit.position, "unit " + quote(unit.name) + " is in no thread",
                      "add it to the units of a [thread.NAME]; until then it would never step");
  }
}

void check_priority(const Thread& thread, Diagnostics& diagnostics) {
  if (thread.priority > highest_below_interrupts && !thread.above_interrupts)
    diagnostics.error(
        thread.position,
        "thread " + quote(thread.name) + " has priority " + std::to_string(thread.priority) + ", above " +
            std::to_string(highest_below_interrupts),
        "interrupt threads live at 50 and above: choose 1 to 49, or say above_interrupts = true");
  if (thread.role == CpuRole::rest && thread.priority > 0)
    diagnostics.error(
        thread.position, "thread " + quote(thread.name) + " has cpu = \"rest\" and a real-time priority",
        "the rest is what real-time threads leave over: set priority = 0, or name a role in place of 'cpu'");
}

void check_real_time(const Model& model, const Thread& thread, Diagnostics& diagnostics) {
  if (thread.priority == 0) return;
  const bool free = std::holds_alternative<FreeTrigger>(thread.trigger);
  if (free)
    diagnostics.error(thread.trigger_position,
                      "thread " + quote(thread.name) + " runs free with real-time priority " +
                          std::to_string(thread.priority),
                      "it would take a CPU for itself: set priority = 0, or give it a period");
  else if (interval_of(thread) == 0)
    diagnostics.error(thread.trigger_position,
                      "real-time thread " + quote(thread.name) + " has no 'min_interval'",
                      thread.io_device ? "add min_interval or period: the shortest time between two "
                                         "releases, which the schedulability analysis needs"
                                       : "add min_interval = \"1 ms\", the shortest time between two "
                                         "releases, which the schedulability analysis needs");
  if (thread.io_device && thread.demand == 0)
    diagnostics.error(thread.position, "real-time IO thread " + quote(thread.name) + " has no 'budget'",
                      "add budget = \"50 us\", how long it takes to serve the device once");
  for (const Index index : thread.units) {
    const Unit& unit = model.units[index];
    const InInstance instance(diagnostics, model, unit.name);
    if (model.unit_types[unit.type].cell_access)
      diagnostics.error(unit.position,
                        "unit " + quote(unit.name) +
                            ", which has access to the whole cell, is in real-time "
                            "thread " +
                            quote(thread.name),
                        "it takes a lock and allocates: put it into a thread without a priority");
    if (unit.budget) continue;
    diagnostics.error(
        unit.position,
        "unit " + quote(unit.name) + " in real-time thread " + quote(thread.name) + " has no 'budget'",
        "add budget = \"100 us\", the longest that one step may take; the schedulability analysis needs it");
  }
}

void check_deadline(const Thread& thread, Diagnostics& diagnostics) {
  const Nanoseconds interval = interval_of(thread);
  if (!thread.deadline || interval == 0 || *thread.deadline <= interval) return;
  const bool periodic = std::holds_alternative<PeriodTrigger>(thread.trigger);
  diagnostics.error(
      thread.position,
      "thread " + quote(thread.name) + " has a deadline of " + duration_text(*thread.deadline) +
          ", later than its " + (periodic ? "period" : "min_interval") + " of " + duration_text(interval),
      "a step is finished before the next begins: shorten the deadline, or release the thread less often");
}

void check_hang_timeout(const Thread& thread, Diagnostics& diagnostics) {
  if (!thread.hang_timeout || thread.priority == 0) return;
  diagnostics.error(
      thread.position, "real-time thread " + quote(thread.name) + " has a 'hang_timeout'",
      "its step hangs after 500 ms, or 20 deadlines where that is longer; what takes more time belongs "
      "into a thread with priority = 0");
}

// A step is told by one bit each which of them fired.
void check_sources(const Thread& thread, Diagnostics& diagnostics) {
  const auto* trigger = std::get_if<SlotsTrigger>(&thread.trigger);
  if (trigger == nullptr || trigger->sources.size() <= max_trigger_sources) return;
  diagnostics.error(thread.trigger_position,
                    "thread " + quote(thread.name) + " waits for " + std::to_string(trigger->sources.size()) +
                        " slots and queues, more than " + std::to_string(max_trigger_sources),
                    "an array counts as all its members: name fewer, or give the thread a period");
}

void check_device_trigger(const Model& model, const Thread& thread, Diagnostics& diagnostics) {
  const auto* trigger = std::get_if<DeviceTrigger>(&thread.trigger);
  if (trigger == nullptr || thread.io_device) return;
  const Device& device = model.devices[trigger->device];
  if (!device.thread) return;  // reported as a device without owner
  const Thread& home = model.threads[*device.thread];
  if (&home == &thread) return;
  diagnostics.error(thread.trigger_position,
                    "thread " + quote(thread.name) + " waits for device " + quote(device.name) +
                        ", which is served by thread " + quote(home.name),
                    home.io_device ? "trigger on a slot or queue that the device publishes"
                                   : "put the device's owner into this thread, or trigger on a slot");
}

}  // namespace

void check_threads(const Model& model, Diagnostics& diagnostics) {
  check_units_once(model, diagnostics);
  if (model.threads.empty() && model.units.empty())
    diagnostics.error(model.application->position, "this application has no units and no threads",
                      "add [unit.NAME] and [thread.NAME] rows");
}

void check_triggers(const Model& model, Diagnostics& diagnostics) {
  for (const Thread& thread : model.threads) {
    const InInstance instance(diagnostics, model, thread.name);
    check_priority(thread, diagnostics);
    if (thread.partial) continue;
    check_real_time(model, thread, diagnostics);
    check_deadline(thread, diagnostics);
    check_hang_timeout(thread, diagnostics);
    check_sources(thread, diagnostics);
    check_device_trigger(model, thread, diagnostics);
  }
}

}  // namespace flexrf::config_gen
