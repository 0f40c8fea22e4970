#include "config-gen/model/memory.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include "config-gen/model/layout.hpp"
#include "config-gen/model/words.hpp"

namespace flexrf::config_gen {
namespace {

std::string times(std::size_t count, const std::string& what, std::size_t bytes) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s") + " of " + size_text(bytes);
}

}  // namespace

std::vector<MemoryItem> memory_map(const Model& model) {
  std::vector<MemoryItem> items;
  for (const Slot& slot : model.slots)
    items.push_back({MemoryItem::Kind::slot, slot.name,
                     slot_control + slot_memory(slot.payload_size, slot.buffers()),
                     times(slot.buffers(), "buffer", slot.payload_size), slot.position});
  for (const Slot& slot : model.slots) {
    if (slot.history == 0) continue;
    const std::size_t entry = entry_size(slot.payload_size);
    items.push_back({MemoryItem::Kind::history, slot.name,
                     history_control + history_memory(slot.payload_size, slot.history),
                     times(slot.history, "entry", entry), slot.position});
    if (slot.history > 1)
      items.back().account = std::to_string(slot.history) + " entries of " + size_text(entry);
  }
  for (const Queue& queue : model.queues) {
    const std::size_t payload = model.types[queue.type].size;
    const std::size_t writers = std::max<std::size_t>(1, queue.writers.size());
    const std::size_t pool = job_memory(payload, queue.capacity);
    const std::size_t ring = ring_memory(payload, queue.capacity);
    const std::size_t bytes = queue.jobs ? job_control + writers * job_sink + pool
                                         : writers * (ring_control + ring) + (writers > 1 ? ring_set : 0);
    items.push_back({MemoryItem::Kind::queue, queue.name, bytes,
                     queue.jobs ? times(1, "pool", pool) : times(writers, "ring", ring), queue.position});
  }
  for (const Thread& thread : model.threads)
    items.push_back({MemoryItem::Kind::stack, thread.name, round_up(thread.stack, page) + page,
                     size_text(thread.stack) + " and a guard page", thread.position});
  for (const Device& device : model.devices) {
    std::size_t helpers = 0;
    for (const DriverChoice& choice : device.drivers)
      helpers = std::max(helpers, model.drivers[choice.driver].helper_threads);
    if (helpers > 0)
      items.push_back({MemoryItem::Kind::helper, device.name, helpers * helper_stack,
                       times(helpers, "stack", helper_stack), device.position});
  }
  for (const Unit& unit : model.units) {
    const UnitType& type = model.unit_types[unit.type];
    const std::size_t bytes = type.configuration.size + type.runtime.size + type.feedback.size;
    items.push_back({MemoryItem::Kind::parameters, unit.name, bytes, "configuration, runtime and feedback",
                     unit.position});
  }
  for (const Device& device : model.devices) {
    const Interface& interface = model.interfaces[device.interface];
    std::size_t bytes = 0;
    for (const DriverChoice& choice : device.drivers) {
      const Driver& driver = model.drivers[choice.driver];
      bytes = std::max(bytes, driver.configuration.size + driver.runtime.size + driver.feedback.size);
    }
    bytes += interface.configuration.size;
    items.push_back({MemoryItem::Kind::parameters, device.name, bytes, "configuration, runtime and feedback",
                     device.position});
  }
  return items;
}

std::size_t total(const std::vector<MemoryItem>& items) {
  return std::accumulate(items.begin(), items.end(), std::size_t{0},
                         [](std::size_t sum, const MemoryItem& item) {
                           constexpr std::size_t most = std::numeric_limits<std::size_t>::max() / 2;
                           return std::min(most, sum + std::min(most, item.bytes));
                         });
}

}  // namespace flexrf::config_gen
