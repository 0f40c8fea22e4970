#include "config-gen/model/memory.hpp"

#include <algorithm>
#include <numeric>

#include "config-gen/model/layout.hpp"
#include "config-gen/model/words.hpp"

namespace flexrf::config_gen {
namespace {

constexpr std::size_t item_header = 16;     // sequence and time
constexpr std::size_t slot_control = 320;   // of a slot without its buffers
constexpr std::size_t ring_control = 256;   // of one writer's ring, or of a pool
constexpr std::size_t buffer_counters = 8;  // taken and given back

std::size_t round_up(std::size_t value, std::size_t to) {
  return (value + to - 1) / to * to;
}

std::string times(std::size_t count, const std::string& what, std::size_t bytes) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s") + " of " + size_text(bytes);
}

}  // namespace

std::size_t buffer_size(std::size_t payload) {
  if (payload >= large_payload) return round_up(payload, page) + cache_line;
  return round_up(item_header + payload, cache_line);
}

std::vector<MemoryItem> memory_map(const Model& model) {
  std::vector<MemoryItem> items;
  for (const Slot& slot : model.slots) {
    const std::size_t buffer = buffer_size(slot.payload_size);
    const std::size_t bytes =
        slot_control + slot.buffers() * buffer + round_up(slot.buffers() * buffer_counters, cache_line);
    items.push_back({MemoryItem::Kind::slot, slot.name, bytes,
                     times(slot.buffers(), "buffer", slot.payload_size), slot.position});
  }
  for (const Slot& slot : model.slots) {
    if (slot.history == 0) continue;
    const std::size_t entry = item_header + round_up(slot.payload_size, 8);
    items.push_back({MemoryItem::Kind::history, slot.name, cache_line + slot.history * entry,
                     times(slot.history, "entry", entry), slot.position});
    if (slot.history > 1)
      items.back().account = std::to_string(slot.history) + " entries of " + size_text(entry);
  }
  for (const Queue& queue : model.queues) {
    const std::size_t rings = queue.jobs ? 1 : std::max<std::size_t>(1, queue.writers.size());
    const std::size_t entry = item_header + round_up(model.types[queue.type].size, 8);
    items.push_back({MemoryItem::Kind::queue, queue.name, rings * (ring_control + queue.capacity * entry),
                     times(rings, queue.jobs ? "pool" : "ring", queue.capacity * entry), queue.position});
  }
  for (const Thread& thread : model.threads)
    items.push_back({MemoryItem::Kind::stack, thread.name, round_up(thread.stack, page) + page,
                     size_text(thread.stack) + " and a guard page", thread.position});
  for (const Unit& unit : model.units) {
    const UnitType& type = model.unit_types[unit.type];
    const std::size_t bytes = type.configuration.size + type.runtime.size + type.feedback.size;
    items.push_back({MemoryItem::Kind::parameters, unit.name, bytes, "configuration, runtime and feedback",
                     unit.position});
  }
  for (const Device& device : model.devices) {
    const Interface& interface = model.interfaces[device.interface];
    std::size_t bytes = 0;
    for (const DriverChoice& choice : device.drivers)
      bytes = std::max(bytes, model.drivers[choice.driver].configuration.size);
    bytes += interface.configuration.size + interface.runtime.size + interface.feedback.size;
    items.push_back({MemoryItem::Kind::parameters, device.name, bytes, "configuration, runtime and feedback",
                     device.position});
  }
  return items;
}

std::size_t total(const std::vector<MemoryItem>& items) {
  return std::accumulate(items.begin(), items.end(), std::size_t{0},
                         [](std::size_t sum, const MemoryItem& item) { return sum + item.bytes; });
}

}  // namespace flexrf::config_gen
