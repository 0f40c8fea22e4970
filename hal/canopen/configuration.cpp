#include "hal/canopen/configuration.hpp"

namespace flexrf::canopen {
namespace {

using Act = ConfigurationStep::Act;

constexpr std::uint32_t pdo_not_in_use = 0x80000000;
// Nobody asks for a PDO by a remote frame.
constexpr std::uint32_t pdo_without_remote = 0x40000000;

}  // namespace

void Configuration::write(ObjectAddress object, std::uint8_t size, std::uint32_t value,
                          const char* helps) noexcept {
  add({.act = Act::write, .size = size, .object = object, .value = value, .held = value, .helps = helps});
}

void Configuration::write_if_there(ObjectAddress object, std::uint8_t size, std::uint32_t value) noexcept {
  add({.act = Act::write, .size = size, .object = object, .value = value, .held = value, .optional = true});
}

void Configuration::ask(ObjectAddress object) noexcept {
  add({.act = Act::ask, .object = object, .optional = true});
}

void Configuration::expect(ObjectAddress object, std::uint32_t value, std::uint32_t mask,
                           const char* meaning) noexcept {
  add({.act = Act::expect, .object = object, .value = value, .mask = mask, .meaning = meaning});
}

void Configuration::configure_pdo(const PdoPlan& plan) noexcept {
  const bool sent = plan.direction == PdoDirection::sent_by_node;
  const std::uint32_t identifier = plan.identifier | (sent && plan.forbids_remote ? pdo_without_remote : 0);
  const auto identify = [&](std::uint32_t value) {
    add({.act = Act::write,
         .object = plan.communication(1),
         .value = value,
         .held = plan.identifier,
         .mask = ~pdo_without_remote,
         .helps = plan.helps});
  };
  identify(pdo_not_in_use | identifier);
  add({.act = Act::map, .size = 1, .object = plan.mapping(0), .value = 0});
  for (std::uint8_t i = 0; i < plan.count; ++i) {
    add({.act = Act::map,
         .object = plan.mapping(static_cast<std::uint8_t>(i + 1)),
         .value = mapping_word(plan.entries[i]),
         .helps = plan.entries[i].helps});
  }
  add({.act = Act::map, .size = 1, .object = plan.mapping(0), .value = plan.count});
  write(plan.communication(2), 1, plan.transmission);
  if (sent && plan.inhibit != 0) write(plan.communication(3), 2, plan.inhibit);
  if (plan.event_timer != 0) write(plan.communication(5), 2, plan.event_timer, plan.event_timer_helps);
  identify(identifier);
}

void Configuration::add(const ConfigurationStep& step) noexcept {
  if (count_ == capacity) {
    complete_ = false;
    return;
  }
  steps_[count_++] = step;
}

}  // namespace flexrf::canopen
