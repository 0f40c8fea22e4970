#include "hal/canopen/simulated_objects.hpp"

#include <algorithm>

#include "hal/canopen/sdo_abort.hpp"

namespace flexrf::canopen {
namespace {

constexpr std::uint32_t not_in_use = 0x80000000;
constexpr std::uint32_t without_remote = 0x40000000;
constexpr std::uint16_t own_objects = 0x2000;

constexpr bool is_mapping(std::uint16_t index) {
  constexpr std::uint16_t pdos = SimulatedObjects::pdos;
  return (index >= 0x1600 && index < 0x1600 + pdos) || (index >= 0x1A00 && index < 0x1A00 + pdos);
}

constexpr std::uint32_t key(ObjectAddress address) {
  return std::uint32_t{address.index} << 8 | address.subindex;
}

constexpr bool is_sent_identifier(ObjectAddress address) {
  return address.index >= 0x1800 && address.index < 0x1800 + SimulatedObjects::pdos && address.subindex == 1;
}

constexpr ObjectAddress communication_of(ObjectAddress mapping) {
  return {static_cast<std::uint16_t>(mapping.index - 0x200), 1};
}

}  // namespace

void SimulatedObjects::add_pdos() {
  for (std::uint16_t i = 0; i < pdos; ++i) {
    for (const std::uint16_t base : {std::uint16_t{0x1400}, std::uint16_t{0x1800}}) {
      const auto communication = static_cast<std::uint16_t>(base + i);
      const auto mapping = static_cast<std::uint16_t>(base + 0x200 + i);
      add({communication, 1}, 4, true, false, not_in_use);
      add({communication, 2}, 1, true, false, 255);
      if (base == 0x1800) add({communication, 3}, 2, true, false);
      add({communication, 5}, 2, true, false);
      add({mapping, 0}, 1, true, false);
      for (std::uint8_t entry = 1; entry <= PdoPlan::most_entries; ++entry) {
        add({mapping, entry}, 4, true, false);
      }
    }
  }
}

void SimulatedObjects::sort() {
  std::sort(objects_.begin(), objects_.begin() + static_cast<std::ptrdiff_t>(count_),
            [](const Object& one, const Object& other) { return key(one.address) < key(other.address); });
}

std::uint32_t SimulatedObjects::read(ObjectAddress address, std::span<std::uint8_t> value,
                                     std::size_t& size) {
  const Object* object = find(address);
  if (object == nullptr) {
    const std::uint8_t highest = address.subindex == 0 ? highest_subindex(address.index) : std::uint8_t{0};
    if (highest == 0) return code_of_missing(address);
    value[0] = highest;
    size = 1;
    return 0;
  }
  write_number(value.data(), object->size, object->value);
  size = object->size;
  return 0;
}

std::uint32_t SimulatedObjects::write(ObjectAddress address, std::span<const std::uint8_t> value) {
  Object* object = find(address);
  if (object == nullptr) {
    const bool is_count = address.subindex == 0 && highest_subindex(address.index) > 0;
    return is_count ? sdo_abort::read_only : code_of_missing(address);
  }
  if (address == refused_ && refusal_ != 0) return refusal_;
  if (!object->writable) return sdo_abort::read_only;
  if (value.size() > object->size) return sdo_abort::too_long;
  if (value.size() < object->size) return sdo_abort::too_short;
  const std::uint64_t number = read_number(value.data(), value.size());
  if (is_mapping(address.index)) {
    if (const std::uint32_t code = check_mapping(address, number); code != 0) return code;
  }
  if (refuses_bit_30_ && is_sent_identifier(address) && (number & without_remote) != 0) {
    return sdo_abort::out_of_range;
  }
  object->value = number;
  return 0;
}

std::uint8_t SimulatedObjects::highest_subindex(std::uint16_t index) const {
  std::uint8_t highest = 0;
  for (const Object& object : std::span(objects_).first(count_)) {
    if (object.address.index == index) highest = std::max(highest, object.address.subindex);
  }
  return highest;
}

std::uint32_t SimulatedObjects::code_of_missing(ObjectAddress address) const {
  const bool is_there = find({address.index, 0}) != nullptr || highest_subindex(address.index) > 0;
  return is_there ? sdo_abort::no_subindex : sdo_abort::no_object;
}

void SimulatedObjects::lack(ObjectAddress address) {
  Object* object = find(address);
  if (object == nullptr) return;
  std::copy(object + 1, objects_.data() + count_, object);
  --count_;
}

void SimulatedObjects::unmap(ObjectAddress address) {
  if (Object* object = find(address)) object->mappable = false;
}

std::uint32_t SimulatedObjects::check_mapping(ObjectAddress address, std::uint64_t value) const {
  if (fixed_mapping_) return sdo_abort::read_only;
  if (!pre_operational_) return sdo_abort::device_state;
  if ((get(communication_of(address)) & not_in_use) == 0) return sdo_abort::access;
  if (address.subindex == 0) return value > PdoPlan::most_entries ? sdo_abort::mapping_too_long : 0;
  if (get({address.index, 0}) != 0) return sdo_abort::access;
  const Object* mapped =
      find({static_cast<std::uint16_t>(value >> 16), static_cast<std::uint8_t>(value >> 8)});
  if (mapped == nullptr) return sdo_abort::no_object;
  const bool fits = mapped->mappable && mapped->size * 8U == (value & 0xFF);
  const bool right_way = address.index >= 0x1A00 || mapped->writable;
  return fits && right_way ? 0 : sdo_abort::not_mappable;
}

std::uint64_t SimulatedObjects::get(ObjectAddress address) const {
  const Object* object = find(address);
  return object == nullptr ? 0 : object->value;
}

std::int64_t SimulatedObjects::get_signed(ObjectAddress address) const {
  const Object* object = find(address);
  return object == nullptr ? 0 : with_sign(object->value, object->size * 8U);
}

void SimulatedObjects::set(ObjectAddress address, std::int64_t value) {
  Object* object = find(address);
  if (object == nullptr) return;
  const std::uint64_t mask = (std::uint64_t{1} << (object->size * 8U)) - 1;  // no object has 8 bytes
  object->value = static_cast<std::uint64_t>(value) & mask;
}

void SimulatedObjects::set_first(ObjectAddress address, std::uint64_t value) {
  if (Object* object = find(address)) object->first = object->value = value;
}

void SimulatedObjects::reset(bool all) {
  for (Object& object : std::span(objects_).first(count_)) {
    if (all || object.address.index < own_objects) object.value = object.first;
  }
}

std::optional<PdoPlan> SimulatedObjects::pdo(PdoDirection direction, std::uint16_t number) const {
  PdoPlan plan{.direction = direction, .number = number};
  const std::uint64_t identifier = get(plan.communication(1));
  if ((identifier & not_in_use) != 0) return std::nullopt;
  plan.identifier = static_cast<std::uint16_t>(identifier & 0x7FF);
  plan.transmission = static_cast<std::uint8_t>(get(plan.communication(2)));
  const std::uint64_t count = get(plan.mapping(0));
  for (std::uint8_t i = 1; i <= count; ++i) {
    const std::uint64_t word = get(plan.mapping(i));
    plan.add({static_cast<std::uint16_t>(word >> 16), static_cast<std::uint8_t>(word >> 8)},
             static_cast<std::uint8_t>(word));
  }
  if (plan.count == 0) return std::nullopt;
  return plan;
}

// Asked some dozen times for each message and step.
std::size_t SimulatedObjects::place_of(ObjectAddress address) const {
  const auto end = objects_.begin() + static_cast<std::ptrdiff_t>(count_);
  const auto found = std::lower_bound(
      objects_.begin(), end, key(address),
      [](const Object& object, std::uint32_t wanted) { return key(object.address) < wanted; });
  return found != end && found->address == address ? static_cast<std::size_t>(found - objects_.begin())
                                                   : count_;
}

SimulatedObjects::Object* SimulatedObjects::find(ObjectAddress address) {
  const std::size_t place = place_of(address);
  return place == count_ ? nullptr : &objects_[place];
}

const SimulatedObjects::Object* SimulatedObjects::find(ObjectAddress address) const {
  const std::size_t place = place_of(address);
  return place == count_ ? nullptr : &objects_[place];
}

void SimulatedObjects::add(ObjectAddress address, std::uint8_t size, bool writable, bool mappable,
                           std::uint64_t first) {
  objects_[count_++] = {address, size, writable, mappable, first, first};
}

}  // namespace flexrf::canopen
