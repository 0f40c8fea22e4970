#include "runtime/executive/tests/fixture.hpp"

#include <sys/mman.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <set>

#include "runtime/blackboard/queue_ring.hpp"

namespace flexrf::fixture {
namespace {

constexpr std::size_t stack_size = 256 * 1024;

struct FreeMemory {
  void operator()(void* memory) const { std::free(memory); }
};
using Memory = std::unique_ptr<void, FreeMemory>;

Memory zeroed(std::size_t size) {
  size = (size + cache_line - 1) / cache_line * cache_line;
  Memory memory{std::aligned_alloc(cache_line, size)};
  std::memset(memory.get(), 0, size);
  return memory;
}

/// Storage of an object, behind what its construct function must know and cannot be told.
template <class Object, class Script>
struct Place {
  const Script* script = nullptr;
  Events* events = nullptr;
  alignas(Object) std::byte object[sizeof(Object)];

  template <class Base>
  static Base* construct(void* storage) {
    auto* place = reinterpret_cast<Place*>(static_cast<std::byte*>(storage) - offsetof(Place, object));
    return new (storage) Object{*place->script, *place->events};
  }
};
using UnitPlace = Place<TestUnit, UnitScript>;
using DevicePlace = Place<TestDevice, DeviceScript>;

struct ThreadReader {
  std::uint16_t thread;
  std::uint16_t slot;
  SlotReader reader;
};

struct Ring {
  Ring(Memory words, QueueRing::Memory view, DropPolicy policy, std::span<Doorbell* const> bells)
      : memory(std::move(words)), ring(descriptor_of<Item>, view, policy, bells) {}
  Memory memory;
  QueueRing ring;
};

}  // namespace

/// What the records point to.
struct TestApplication::Made {
  std::deque<std::string> texts;
  std::deque<Memory> memory;
  std::deque<Doorbell> bells;
  std::deque<StepContext> contexts;
  std::deque<void*> stacks;
  std::deque<std::vector<Doorbell*>> bell_lists;
  std::deque<SlotControl> slots;
  std::deque<SlotReader> observers;
  std::deque<ThreadReader> readers;
  std::deque<Ring> rings;
  std::deque<RingSet> ring_sets;
  std::deque<UnitPlace> unit_places;
  std::deque<DevicePlace> device_places;
  std::deque<Device*> instances;
  std::deque<DriverRecord> drivers;
  std::deque<std::vector<InputBinding>> inputs;
  std::deque<std::vector<SlotControl*>> outputs;
  std::deque<std::vector<QueueSource*>> sources;
  std::deque<std::vector<QueueSink*>> sinks;
  std::deque<std::vector<std::span<QueueSink* const>>> sink_lists;
  std::deque<std::vector<Device* const*>> devices;
  std::deque<std::vector<TriggerSource>> trigger_sources;
  std::deque<std::vector<const char*>> names;
  std::vector<std::vector<QueueSink*>> writers_of_queue;  // in order of units, then devices
  std::vector<QueueRecord> queue_records;
  std::vector<DeviceRecord> device_records;
  std::vector<UnitRecord> unit_records;
  std::vector<PopulationRecord> population_records;
  std::vector<ThreadRecord> thread_records;

  std::span<QueueSink* const> sink(std::uint16_t queue, std::size_t& next) {
    return {&writers_of_queue[queue][next++], 1};
  }

  ~Made() {
    for (void* stack : stacks) {
      mprotect(stack, stack_size, PROT_READ | PROT_WRITE);
      munmap(stack, stack_size);
    }
  }
};

TestApplication::TestApplication() = default;
TestApplication::~TestApplication() = default;

namespace {

template <class Plan>
std::uint16_t append(std::vector<Plan>& plans, Plan plan) {
  plans.push_back(std::move(plan));
  return static_cast<std::uint16_t>(plans.size() - 1);
}

}  // namespace

std::uint16_t TestApplication::add(SlotPlan slot) {
  return append(slots_, std::move(slot));
}
std::uint16_t TestApplication::add(QueuePlan queue) {
  return append(queues_, std::move(queue));
}
std::uint16_t TestApplication::add(DevicePlan device) {
  return append(devices_, std::move(device));
}
std::uint16_t TestApplication::add(UnitPlan unit) {
  return append(units_, std::move(unit));
}
std::uint16_t TestApplication::add(ThreadPlan thread) {
  return append(threads_, std::move(thread));
}
void TestApplication::add(PopulationPlan population) {
  populations_.push_back(std::move(population));
}

// ---- making the records

const Application& TestApplication::application() {
  if (made_ == nullptr) {
    made_ = std::make_unique<Made>();
    unit_states_ = std::vector<UnitState>(units_.size());
    device_states_ = std::vector<DeviceState>(devices_.size());
    thread_states_ = std::vector<ThreadState>(threads_.size());
    made_->bells.resize(threads_.size());
    made_->contexts.resize(threads_.size());
    made_->instances.resize(devices_.size());
    make_slots();
    make_queues();
    make_devices();
    make_units();
    make_threads();
    fill_application();
  }
  return application_;
}

const char* TestApplication::keep(std::string text) {
  return made_->texts.emplace_back(std::move(text)).c_str();
}

std::uint16_t TestApplication::thread_of_unit(std::uint16_t unit) const {
  for (std::size_t i = 0; i < threads_.size(); ++i) {
    if (std::ranges::count(threads_[i].units, unit) != 0) return static_cast<std::uint16_t>(i);
  }
  return 0;
}

std::uint16_t TestApplication::thread_of_device(std::uint16_t device) const {
  for (std::size_t i = 0; i < threads_.size(); ++i) {
    if (std::ranges::count(threads_[i].devices, device) != 0) return static_cast<std::uint16_t>(i);
  }
  return 0;
}

std::vector<Doorbell*> TestApplication::bells_of(const std::vector<std::uint16_t> TriggerPlan::*sources,
                                                 std::uint16_t index) {
  std::vector<Doorbell*> bells;
  for (std::size_t i = 0; i < threads_.size(); ++i) {
    // A thread that backs off polls: nobody wakes it.
    if (threads_[i].trigger.kind != TriggerKind::slots) continue;
    if (std::ranges::count(threads_[i].trigger.*sources, index) != 0) bells.push_back(&made_->bells[i]);
  }
  return bells;
}

SlotControl* TestApplication::make_slot(const char* name, const char* writer, const TypeDescriptor& type,
                                        std::uint8_t readers, std::vector<Doorbell*> bells, bool observe,
                                        bool wall) {
  const std::uint8_t all_readers = static_cast<std::uint8_t>(readers + (observe ? 1 : 0));
  const std::uint8_t buffers = static_cast<std::uint8_t>(all_readers + 2);
  const std::size_t stride = (sizeof(ItemHeader) + type.size + cache_line - 1) / cache_line * cache_line;
  auto* items = static_cast<std::byte*>(made_->memory.emplace_back(zeroed(buffers * stride)).get());
  void* taken = made_->memory.emplace_back(zeroed(buffers * sizeof(std::uint32_t))).get();
  void* given = made_->memory.emplace_back(zeroed(buffers * sizeof(std::uint32_t))).get();
  const SlotControl::Memory memory{items,
                                   items + sizeof(ItemHeader),
                                   static_cast<std::uint32_t>(stride),
                                   static_cast<std::uint32_t>(stride),
                                   static_cast<std::uint32_t*>(taken),
                                   static_cast<std::atomic<std::uint32_t>*>(given),
                                   buffers,
                                   1,
                                   all_readers == 1};
  SlotControl& slot =
      made_->slots.emplace_back(&type, memory, made_->bell_lists.emplace_back(std::move(bells)));
  SlotReader* observer = observe ? &made_->observers.emplace_back(&slot) : nullptr;
  slot_records_.push_back({name, "", &slot, observer, writer, wall});
  return &slot;
}

SlotReader* TestApplication::reader_of(std::uint16_t thread, std::uint16_t slot) {
  for (ThreadReader& reader : made_->readers) {
    if (reader.thread == thread && reader.slot == slot) return &reader.reader;
  }
  return &made_->readers.emplace_back(ThreadReader{thread, slot, SlotReader{slot_records_[slot].control}})
              .reader;
}

void TestApplication::make_slots() {
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    const auto index = static_cast<std::uint16_t>(i);
    std::set<std::uint16_t> threads;
    std::string writer;
    for (std::size_t u = 0; u < units_.size(); ++u) {
      for (const InputPlan& input : units_[u].inputs) {
        if (input.slot == index) threads.insert(thread_of_unit(static_cast<std::uint16_t>(u)));
      }
      for (std::size_t port = 0; port < units_[u].outputs.size(); ++port) {
        if (units_[u].outputs[port] != index) continue;
        writer = units_[u].name + "." + TestUnit::type.ports[TestUnit::ports + port].name;
      }
    }
    for (std::size_t d = 0; d < devices_.size(); ++d) {
      if (devices_[d].output == index) writer = devices_[d].name + ".output";
      if (devices_[d].reads == index) threads.insert(thread_of_device(static_cast<std::uint16_t>(d)));
    }
    make_slot(slots_[i].name.c_str(), keep(writer), *descriptor_of<Item>,
              static_cast<std::uint8_t>(threads.size()), bells_of(&TriggerPlan::slots, index),
              slots_[i].observe, slots_[i].wall);
  }
}

void TestApplication::make_queues() {
  made_->writers_of_queue.resize(queues_.size());
  for (std::size_t i = 0; i < queues_.size(); ++i) {
    const auto index = static_cast<std::uint16_t>(i);
    const QueuePlan& plan = queues_[i];
    const auto& bells = made_->bell_lists.emplace_back(bells_of(&TriggerPlan::queues, index));
    std::vector<const char*>& writers = made_->names.emplace_back();
    std::vector<const char*>& readers = made_->names.emplace_back();
    for (const UnitPlan& unit : units_) {
      if (unit.pushes == index) writers.push_back(keep(unit.name + ".orders"));
      if (unit.pops == index) readers.push_back(keep(unit.name + ".jobs"));
    }
    for (const DevicePlan& device : devices_) {
      if (device.pushes == index) writers.push_back(keep(device.name + ".orders"));
      if (device.pops == index) readers.push_back(keep(device.name + ".jobs"));
    }
    auto& rings = made_->memory.emplace_back(zeroed(writers.size() * sizeof(void*)));
    auto** ring_list = static_cast<QueueRing**>(rings.get());
    const std::uint32_t entries = std::bit_ceil(plan.capacity);
    for (std::size_t w = 0; w < writers.size(); ++w) {
      Memory words = zeroed(entries * RingEntry::words(sizeof(Item)) * sizeof(std::uint64_t));
      const QueueRing::Memory view{static_cast<std::atomic<std::uint64_t>*>(words.get()), entries,
                                   plan.capacity};
      ring_list[w] = &made_->rings.emplace_back(std::move(words), view, plan.policy, bells).ring;
      made_->writers_of_queue[i].push_back(ring_list[w]);
    }
    std::vector<QueueSource*>& sources = made_->sources.emplace_back();
    sources.push_back(
        &made_->ring_sets.emplace_back(descriptor_of<Item>, std::span{ring_list, writers.size()}));
    made_->queue_records.push_back({plan.name.c_str(), "", descriptor_of<Item>, plan.capacity,
                                    made_->writers_of_queue[i], writers, sources, readers, false});
  }
}

void TestApplication::make_devices() {
  std::vector<std::size_t> next(queues_.size());
  for (std::size_t q = 0; q < queues_.size(); ++q) {
    next[q] = static_cast<std::size_t>(
        std::ranges::count_if(units_, [q](const UnitPlan& unit) { return unit.pushes == q; }));
  }
  for (std::size_t i = 0; i < devices_.size(); ++i) {
    const DevicePlan& plan = devices_[i];
    DevicePlace& place = made_->device_places.emplace_back();
    place.script = &plan.script;
    place.events = &events_;
    const std::uint16_t thread = thread_of_device(static_cast<std::uint16_t>(i));
    std::uint16_t owner = no_index;
    for (std::size_t u = 0; u < units_.size(); ++u) {
      if (units_[u].device == i) owner = static_cast<std::uint16_t>(u);
    }
    std::vector<InputBinding>& inputs = made_->inputs.emplace_back();
    if (plan.reads != no_index) inputs.push_back({reader_of(thread, plan.reads), 1, {}, nullptr});
    std::vector<SlotControl*>& outputs = made_->outputs.emplace_back();
    if (plan.output != no_index) outputs.push_back(slot_records_[plan.output].control);
    std::vector<QueueSource*>& sources = made_->sources.emplace_back();
    if (plan.pops != no_index) sources.push_back(made_->queue_records[plan.pops].sources[0]);
    std::vector<std::span<QueueSink* const>>& sinks = made_->sink_lists.emplace_back();
    if (plan.pushes != no_index) sinks.push_back(made_->sink(plan.pushes, next[plan.pushes]));
    const DriverRecord& driver = made_->drivers.emplace_back(
        DriverRecord{name_of(plan.kind), plan.kind, plan.actuates, plan.virtual_time, sizeof(TestDevice),
                     &DevicePlace::construct<Device>, &TestDevice::type, nullptr, nullptr, plan.options});
    DeviceRecord record{};
    record.index = static_cast<ComponentIndex>(units_.size() + i);
    record.kind = "device";
    record.level = level_base;
    for (std::uint16_t bus = plan.bus; bus != no_index; bus = devices_[bus].bus) ++record.level;
    record.name = plan.name.c_str();
    record.summary = "";
    record.interface = "Actuator";
    record.drivers = {&driver, 1};
    record.storage = place.object;
    record.storage_size = sizeof(place.object);
    record.instance = &made_->instances[i];
    record.binding.context = &made_->contexts[thread];
    record.binding.inputs = inputs;
    record.binding.queue_inputs = sources;
    record.binding.outputs = outputs;
    record.binding.queue_outputs = sinks;
    record.bus = plan.bus;
    record.thread = thread;
    record.unit = owner;
    record.initialise_timeout = plan.initialise_timeout;
    record.stop_timeout = plan.initialise_timeout;
    record.required = plan.required;
    made_->device_records.push_back(record);
  }
}

void TestApplication::make_units() {
  std::vector<std::size_t> next(queues_.size());
  for (std::size_t i = 0; i < units_.size(); ++i) {
    const auto index = static_cast<std::uint16_t>(i);
    const UnitPlan& plan = units_[i];
    UnitPlace& place = made_->unit_places.emplace_back();
    place.script = &plan.script;
    place.events = &events_;
    const std::uint16_t thread = thread_of_unit(index);
    std::vector<InputBinding>& inputs = made_->inputs.emplace_back();
    for (const InputPlan& input : plan.inputs) {
      inputs.push_back(input.slot == no_index
                           ? InputBinding{}
                           : InputBinding{reader_of(thread, input.slot), 1, input.max_age, nullptr});
    }
    std::vector<SlotControl*>& outputs = made_->outputs.emplace_back();
    for (const std::uint16_t slot : plan.outputs) outputs.push_back(slot_records_[slot].control);
    std::vector<QueueSource*>& sources = made_->sources.emplace_back();
    sources.push_back(plan.pops == no_index ? nullptr : made_->queue_records[plan.pops].sources[0]);
    std::vector<std::span<QueueSink* const>>& sinks = made_->sink_lists.emplace_back();
    sinks.push_back(plan.pushes == no_index ? std::span<QueueSink* const>{}
                                            : made_->sink(plan.pushes, next[plan.pushes]));
    std::vector<Device* const*>& devices = made_->devices.emplace_back();
    if (plan.device != no_index) devices.push_back(&made_->instances[plan.device]);
    UnitRecord record{};
    record.index = index;
    record.kind = "unit";
    record.level = level_unit;
    record.name = plan.name.c_str();
    record.summary = "Follows its script.";
    record.type = &TestUnit::type;
    record.construct = &UnitPlace::construct<Unit>;
    record.storage = place.object;
    record.storage_size = sizeof(place.object);
    record.binding = {{&made_->contexts[thread], inputs, sources, outputs, sinks}, devices};
    record.configuration = &TestUnit::default_configuration;
    record.runtime = &TestUnit::default_settings;
    if (plan.parameters) {
      record.runtime_slot =
          make_slot(keep(plan.name + ".runtime"), "", *descriptor_of<Settings>, 0, {}, true, false);
      record.feedback_slot =
          make_slot(keep(plan.name + ".feedback"), "", *descriptor_of<Readings>, 0, {}, true, false);
    }
    record.thread = thread;
    for (std::size_t p = 0; p < populations_.size(); ++p) {
      if (i < populations_[p].first_unit || i >= populations_[p].first_unit + populations_[p].capacity)
        continue;
      record.population = static_cast<std::uint16_t>(p);
      record.member = static_cast<std::uint16_t>(i - populations_[p].first_unit);
    }
    record.restart = plan.restart;
    record.budget = plan.budget;
    record.initialise_timeout = plan.initialise_timeout;
    record.stop_timeout = plan.stop_timeout;
    made_->unit_records.push_back(record);
  }
}

void TestApplication::make_threads() {
  for (std::size_t i = 0; i < threads_.size(); ++i) {
    const ThreadPlan& plan = threads_[i];
    std::vector<TriggerSource>& sources = made_->trigger_sources.emplace_back();
    for (const std::uint16_t slot : plan.trigger.slots)
      sources.push_back({slot_records_[slot].control, nullptr});
    for (const std::uint16_t queue : plan.trigger.queues)
      sources.push_back({nullptr, made_->queue_records[queue].sources[0]});
    void* stack =
        mmap(nullptr, stack_size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_STACK, -1, 0);
    if (stack == MAP_FAILED) std::abort();
    made_->stacks.push_back(stack);
    ThreadRecord record{};
    record.name = plan.name.c_str();
    record.summary = "";
    record.trigger = {plan.trigger.kind,         plan.trigger.period,   plan.trigger.phase,
                      plan.trigger.min_interval, plan.trigger.timeout,  sources,
                      plan.trigger.device,       plan.trigger.shortest, plan.trigger.longest,
                      plan.trigger.tries};
    record.priority = plan.priority;
    record.role = CpuRole::any;
    record.overrun = plan.overrun;
    record.limit = plan.limit;
    for (const std::uint16_t unit : plan.units) record.budget += units_[unit].budget;
    record.deadline = plan.deadline;
    record.hang_timeout = plan.hang_timeout;
    record.units = plan.units;
    record.devices = plan.devices;
    record.stack = stack;
    record.stack_size = stack_size;
    record.context = &made_->contexts[i];
    record.bell = &made_->bells[i];
    made_->thread_records.push_back(record);
  }
}

void TestApplication::fill_application() {
  for (const PopulationPlan& plan : populations_) {
    made_->population_records.push_back({plan.name.c_str(), plan.first_unit, plan.capacity, plan.active});
  }
  application_.name = "test_cell";
  application_.summary = "A cell for tests.";
  application_.descriptor_hash = 0x7E57;
  application_.descriptor_json = "{}";
  application_.memory_budget = 8 * 1024 * 1024;
  application_.autostart = autostart;
  application_.stop_timeout = stop_timeout;
  application_.finish_timeout = finish_timeout;
  application_.slots = slot_records_;
  application_.queues = made_->queue_records;
  application_.devices = made_->device_records;
  application_.units = made_->unit_records;
  application_.populations = made_->population_records;
  application_.threads = made_->thread_records;
  application_.renames = renames;
  application_.save = save;
  application_.unit_states = unit_states_;
  application_.device_states = device_states_;
  application_.thread_states = thread_states_;
}

}  // namespace flexrf::fixture
