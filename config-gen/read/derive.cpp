// What follows from the connections: who reads with how many buffers, who rings whom, what lives where.
#include <algorithm>

#include "config-gen/model/limits.hpp"
#include "config-gen/model/ports.hpp"
#include "config-gen/read/assembly.hpp"

namespace flexrf::config_gen {
namespace {

// Which of its drivers a device has is known at the start only: its slots are as large as any needs. None:
// neither its interface nor a driver has parameters of this kind.
std::optional<SlotType> largest_type(const Model& model, const Device& device, Parameter::Kind kind) {
  const bool is_runtime = kind == Parameter::Kind::runtime;
  const Interface& interface = model.interfaces[device.interface];
  std::optional<SlotType> largest;
  if (!(is_runtime ? interface.runtime : interface.feedback).empty())
    largest = {is_runtime ? SlotType::Kind::interface_runtime : SlotType::Kind::interface_feedback,
               device.interface};
  for (const DriverChoice& choice : device.drivers) {
    const Driver& driver = model.drivers[choice.driver];
    if ((is_runtime ? driver.runtime : driver.feedback).empty()) continue;
    const SlotType type{is_runtime ? SlotType::Kind::driver_runtime : SlotType::Kind::driver_feedback,
                        choice.driver};
    if (!largest || size_of(model, type) > size_of(model, *largest)) largest = type;
  }
  return largest;
}

void add_parameter_slots(Model& model) {
  const auto add = [&](const std::string& name, const Position& position, SlotType::Kind kind, Index type,
                       Writer::Kind writer, const PortOwner& owner) {
    Slot slot;
    slot.name = name;
    slot.position = position;
    slot.type = {kind, type};
    slot.writer = {writer, owner, 0, position};
    model.slots.push_back(std::move(slot));
    return model.slots.size() - 1;
  };
  for (Index i = 0; i < model.devices.size(); ++i) {
    Device& device = model.devices[i];
    const PortOwner owner{PortOwner::Kind::device, i, 0};
    if (const auto type = largest_type(model, device, Parameter::Kind::feedback))
      device.feedback_slot = add(device.name + ".feedback", device.position, type->kind, type->index,
                                 Writer::Kind::feedback, owner);
    if (const auto type = largest_type(model, device, Parameter::Kind::runtime))
      device.values_slot =
          add(device.name + ".values", device.position, type->kind, type->index, Writer::Kind::values, owner);
  }
  for (Index i = 0; i < model.units.size(); ++i) {
    Unit& unit = model.units[i];
    const UnitType& type = model.unit_types[unit.type];
    const PortOwner owner{PortOwner::Kind::unit, i, 0};
    if (!type.feedback.parameters.empty())
      unit.feedback_slot = add(unit.name + ".feedback", unit.position, SlotType::Kind::unit_feedback,
                               unit.type, Writer::Kind::feedback, owner);
    if (!type.runtime.parameters.empty())
      unit.values_slot = add(unit.name + ".values", unit.position, SlotType::Kind::unit_runtime, unit.type,
                             Writer::Kind::values, owner);
  }
}

// share = "copies": a queue of its own for each reader, next to each other.
void split_copies(Assembly& assembly) {
  Model& model = assembly.model;
  if (assembly.copied.empty()) return;
  std::vector<Queue> queues;
  for (Queue& queue : model.queues) {
    const auto readers = readers_at_work(queue);
    if (!assembly.copied.contains(queue.declared) || readers.size() < 2) {
      assembly.queues[queue.declared] = {queues.size()};
      queues.push_back(std::move(queue));
      continue;
    }
    std::vector<Index>& copies = assembly.queues[queue.declared];
    copies.clear();
    for (const std::vector<InputReference>& group : readers) {
      Queue copy = queue;
      const PortSet ports = ports_of(model, group.front().owner);
      copy.name = queue.declared + "@" + ports.name + "." + ports.inputs[group.front().port].name;
      copy.readers = group;
      copies.push_back(queues.size());
      queues.push_back(std::move(copy));
    }
  }
  model.queues = std::move(queues);
  for (const PortOwner& owner : port_owners(model)) {
    for (OutputConnection& output : outputs_of(model, owner)) output.queues.clear();
    if (owner.kind == PortOwner::Kind::device) continue;
    for (InputConnection& input : inputs_of(model, owner)) input.queue.reset();
  }
  for (Index q = 0; q < model.queues.size(); ++q) {
    for (const InputReference& reader : model.queues[q].readers)
      inputs_of(model, reader.owner)[reader.port].queue = q;
    for (const Writer& writer : model.queues[q].writers)
      outputs_of(model, writer.owner)[writer.port].queues.push_back(q);
  }
}

// A trigger on a queue that was split: the copies that are read in this thread, else all.
void split_triggers(Assembly& assembly, const std::vector<std::string>& before) {
  Model& model = assembly.model;
  if (assembly.copied.empty()) return;
  const auto own = [&](Index thread, const std::string& name) {
    std::vector<Index> found;
    for (const Index q : assembly.queues[name])
      for (const InputReference& reader : model.queues[q].readers)
        if (ports_of(model, reader.owner).thread == thread && (found.empty() || found.back() != q))
          found.push_back(q);
    return found.empty() ? assembly.queues[name] : found;
  };
  for (Index t = 0; t < model.threads.size(); ++t) {
    if (auto* slots = std::get_if<SlotsTrigger>(&model.threads[t].trigger)) {
      std::vector<SourceReference> sources;
      for (const SourceReference& source : slots->sources) {
        if (!source.queue) {
          sources.push_back(source);
          continue;
        }
        for (const Index q : own(t, before[source.index])) sources.push_back({true, q});
      }
      slots->sources = std::move(sources);
    } else if (auto* backoff = std::get_if<BackoffTrigger>(&model.threads[t].trigger);
               backoff != nullptr && backoff->source.queue) {
      backoff->source.index = own(t, before[backoff->source.index]).front();
    }
  }
}

void add_readers(Model& model, Slot& slot) {
  std::vector<SlotReader> held;
  for (const InputReference& input : slot.inputs) {
    const PortSet ports = ports_of(model, input.owner);
    if (!ports.thread) continue;
    if (ports.inputs[input.port].hold) {
      held.push_back({SlotReader::Kind::held_input, *ports.thread, 0, 2});
      continue;
    }
    const bool known = std::any_of(slot.readers.begin(), slot.readers.end(),
                                   [&](const SlotReader& r) { return r.thread == *ports.thread; });
    if (!known) slot.readers.push_back({SlotReader::Kind::thread, *ports.thread, 0, 1});
  }
  std::sort(slot.readers.begin(), slot.readers.end(),
            [](const SlotReader& a, const SlotReader& b) { return a.thread < b.thread; });
  slot.readers.insert(slot.readers.end(), held.begin(), held.end());
  if (slot.observe) slot.readers.push_back({SlotReader::Kind::observer, 0, 0, 1});
  for (SlotReader& reader : slot.readers) {
    reader.first = slot.reader_count;
    slot.reader_count += reader.readers;
  }
}

void add_doorbells(Model& model) {
  const auto add = [](std::vector<Index>& bells, Index thread) {
    if (std::find(bells.begin(), bells.end(), thread) == bells.end()) bells.push_back(thread);
  };
  for (Index t = 0; t < model.threads.size(); ++t)
    if (const auto* slots = std::get_if<SlotsTrigger>(&model.threads[t].trigger))
      for (const SourceReference& source : slots->sources)
        add(source.queue ? model.queues[source.index].doorbells : model.slots[source.index].doorbells, t);
}

// A device lives in its IO thread, else in its owner's; a bus without either, with what it carries; and what
// a bus with an IO thread carries lives with its owners, as any other device.
void place_devices(Model& model) {
  for (Device& device : model.devices) {
    if (device.io_thread)
      device.thread = device.io_thread;
    else if (device.owner_unit)
      device.thread = model.units[*device.owner_unit].thread;
  }
  // Buses may carry buses: as often as there are devices is enough for the longest chain.
  for (std::size_t round = 0; round < model.devices.size(); ++round) {
    bool changed = false;
    for (Device& device : model.devices) {
      if (device.thread || device.children.empty()) continue;
      device.thread = model.devices[device.children.front()].thread;
      changed = changed || device.thread;
    }
    if (!changed) break;
  }
}

void order_devices(Model& model) {
  std::vector<bool> done(model.devices.size(), false);
  const auto visit = [&](const auto& self, Index index) -> void {
    if (done[index]) return;
    done[index] = true;
    for (const Index child : model.devices[index].children) self(self, child);
    model.safe_order.push_back(index);
  };
  for (Index i = 0; i < model.devices.size(); ++i) visit(visit, i);
  for (auto index = model.safe_order.rbegin(); index != model.safe_order.rend(); ++index)
    if (const auto thread = model.devices[*index].thread) model.threads[*thread].devices.push_back(*index);
}

}  // namespace

void derive(Assembly& assembly) {
  Model& model = assembly.model;
  place_devices(model);
  order_devices(model);
  std::vector<std::string> queues;
  for (const Queue& queue : model.queues) queues.push_back(queue.declared);
  split_copies(assembly);
  split_triggers(assembly, queues);
  add_parameter_slots(model);
  for (Slot& slot : model.slots) {
    if (slot.type.kind == SlotType::Kind::declared && slot.elements == 0) {
      if (const Field* const field = model.types[slot.type.index].resizable(); field != nullptr)
        slot.elements = field->elements();
    }
    slot.payload_size = size_of(model, slot.type, slot.elements);
    slot.payload_alignment = alignment_of(model, slot.type);
    add_readers(model, slot);
  }
  add_doorbells(model);
  // More than the longest duration is as good as endless, and sums of it do not overflow.
  for (Thread& thread : model.threads)
    for (const Index unit : thread.units)
      thread.demand = std::min(max_duration, thread.demand + model.units[unit].budget.value_or(0));
}

}  // namespace flexrf::config_gen
