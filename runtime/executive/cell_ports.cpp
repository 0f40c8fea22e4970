// The cell's half that knows what components read and write.
#include <algorithm>

#include "runtime/core/digest.hpp"
#include "runtime/executive/cell.hpp"

namespace flexrf {

/// What other drivers would write nobody writes: that is what their slots' readers are told.
void Cell::choose_ports() noexcept {
  for (const DeviceRecord& device : application_->devices) {
    for (const DriverRecord& other : device.drivers) {
      if (other.ports == nullptr) continue;
      for (SlotControl* slot : other.ports->outputs)
        if (slot != nullptr) slot->set_writer_state(WriterState::not_chosen);
    }
    const DriverRecord& chosen = *application_->component_state(device.index).driver;
    if (chosen.ports != nullptr) ports_[device.index] = chosen.ports;
    for (SlotControl* slot : ports(device.index).outputs)
      if (slot != nullptr) slot->set_writer_state(WriterState::waiting);
  }
}

bool Cell::is_abandoned(const QueueSource* source) const noexcept {
  bool another_would = false;
  for (const DeviceRecord& device : application_->devices)
    for (const DriverRecord& driver : device.drivers)
      another_would = another_would || (driver.ports != nullptr && driver.ports->takes_from(source));
  return another_would && std::none_of(ports_.begin(), ports_.end(), [source](const PortBinding* ports) {
           return ports->takes_from(source);
         });
}

void Cell::connect_device(std::uint16_t index) noexcept {
  const DeviceRecord& record = application_->devices[index];
  DeviceBinding binding = record.binding;
  static_cast<PortBinding&>(binding) = ports(record.index);
  if (record.bus != no_index) binding.bus = application_->device_states[record.bus].device;
  application_->device_states[index].device->connect(binding);
}

void Cell::set_writer_state(ComponentIndex component, WriterState state) noexcept {
  for (SlotControl* slot : ports(component).outputs) {
    if (slot != nullptr) slot->set_writer_state(state);
  }
}

void Cell::commit(ComponentIndex component) noexcept {
  for (SlotControl* slot : ports(component).outputs) {
    if (slot != nullptr) slot->commit();
  }
  for (const std::span<QueueSink* const> sinks : ports(component).queue_outputs) {
    for (QueueSink* sink : sinks) sink->commit();
  }
  if (SlotControl* const slot = application_->component(component).feedback_slot; slot != nullptr)
    slot->commit();
}

void Cell::prepare_virtual_time(bool digest) noexcept {
  for (const SlotRecord& slot : application_->slots) {
    slot.control->set_digested(digest && !slot.wall);
  }
  for (const QueueRecord& queue : application_->queues) {
    for (QueueSink* sink : queue.sinks) {
      sink->set_digested(digest && !queue.wall);
      sink->set_deferred(true);
    }
  }
  // Values in force are published between two steps and visible at once; everything else waits for its
  // commit.
  const auto defer = [](SlotControl* slot) {
    if (slot != nullptr) slot->set_deferred(true);
  };
  for (ComponentIndex i = 0; i < application_->component_count(); ++i) {
    for (SlotControl* slot : ports(i).outputs) defer(slot);
    defer(application_->component(i).feedback_slot);
  }
}

std::uint64_t Cell::digest() const noexcept {
  Digest digest;
  for (const SlotRecord& slot : application_->slots) {
    if (slot.wall) continue;
    digest.add_text(slot.name);
    digest.add(slot.control->digest());
  }
  for (const QueueRecord& queue : application_->queues) {
    if (queue.wall) continue;
    digest.add_text(queue.name);
    for (const QueueSink* sink : queue.sinks) digest.add(sink->digest());
  }
  return digest.value();
}

}  // namespace flexrf
