#include "runtime/face/observed_slots.hpp"

#include <algorithm>
#include <cstring>

namespace flexrf {

std::string reason_text(const Cell& cell, std::uint16_t slot, NullReason reason) {
  if (reason == NullReason::none) return "";
  if (reason != NullReason::driver_not_chosen) return name_of(reason);
  const Application& application = cell.application();
  const SlotControl* const control = application.slots[slot].control;
  for (const DeviceRecord& device : application.devices) {
    std::string drivers;
    std::size_t count = 0;
    for (const DriverRecord& driver : device.drivers) {
      if (driver.ports == nullptr || std::ranges::count(driver.ports->outputs, control) == 0) continue;
      drivers += std::string(count++ == 0 ? "'" : " and '") + driver.name + "'";
    }
    if (count == 0) continue;
    return (count == 1 ? "written by driver " : "written by drivers ") + drivers + " of device '" +
           device.name + (count == 1 ? "', which was not chosen" : "', none of which was chosen");
  }
  return name_of(reason);
}

const ObservedSlot& ObservedSlots::read(std::uint16_t slot) {
  Cached& cached = slots_[slot];
  if (cached.turn == turn_) return cached.newest;
  cached.turn = turn_;
  ObservedSlot& newest = cached.newest;
  if (cell_->application().slots[slot].observer == nullptr) {
    newest.reason = NullReason::not_registered;
    return newest;
  }
  if (cached.bytes.size() != size(slot)) cached.bytes.resize(size(slot));
  newest = look_at(*cell_, slot, [&](const ItemHeader& header, const void* payload) {
    if (header.sequence != newest.header.sequence)
      std::memcpy(cached.bytes.data(), payload, cached.bytes.size());
  });
  if (newest.header.sequence != 0) newest.last = cached.bytes.data();
  if (newest.reason == NullReason::none) newest.value = newest.last;
  return newest;
}

ObservedSlot ObservedSlots::read_header(std::uint16_t slot) {
  return look_at(*cell_, slot, [](const ItemHeader&, const void*) {});
}

}  // namespace flexrf
