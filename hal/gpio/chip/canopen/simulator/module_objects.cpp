#include "hal/gpio/chip/canopen/simulator/module_objects.hpp"

#include "hal/canopen/cia401.hpp"
#include "hal/canopen/message.hpp"

namespace flexrf {
namespace {

namespace module = canopen::cia401::objects;

constexpr std::uint32_t has_inputs = 0x10000;  // of object 1000
constexpr std::uint32_t has_outputs = 0x20000;

}  // namespace

ModuleObjects::ModuleObjects(std::uint8_t node, std::uint8_t input_bytes, std::uint8_t output_bytes) {
  add(canopen::objects::device_type, 4, false, false,
      canopen::cia401::profile_number | (input_bytes > 0 ? has_inputs : 0) |
          (output_bytes > 0 ? has_outputs : 0));
  add(canopen::objects::error_register, 1, false, false);
  add(canopen::objects::sync, 4, true, false, canopen::sync_identifier);
  add(canopen::objects::guard_time, 2, true, false);
  add(canopen::objects::life_time_factor, 1, true, false);
  add(canopen::objects::consumer_heartbeat, 4, true, false);
  add(canopen::objects::producer_heartbeat, 2, true, false);
  add(canopen::objects::vendor, 4, false, false, 0x00000123);
  add(canopen::objects::product, 4, false, false, 0x00000456);
  add(canopen::objects::error_behaviour, 1, true, false);
  add_pdos();
  if (input_bytes > 0) add(module::interrupts, 1, true, false);
  for (std::uint8_t byte = 1; byte <= input_bytes; ++byte) {
    add(module::input(byte), 1, false, true);
    add(module::input_polarity(byte), 1, true, false);
    add(module::interrupt_mask(byte), 1, true, false, canopen::cia401::all_lines);
  }
  for (std::uint8_t byte = 1; byte <= output_bytes; ++byte) {
    add(module::output(byte), 1, true, true);
    add(module::output_polarity(byte), 1, true, false);
    add(module::error_mode(byte), 1, true, false, canopen::cia401::all_lines);
    add(module::error_value(byte), 1, true, false);
    add(module::output_mask(byte), 1, true, false, canopen::cia401::all_lines);
  }
  sort();

  canopen::PdoPlan sent{.direction = canopen::PdoDirection::sent_by_node};
  canopen::PdoPlan received{.direction = canopen::PdoDirection::received_by_node};
  for (std::uint8_t byte = 1; byte <= input_bytes; ++byte) sent.add(module::input(byte), 8);
  for (std::uint8_t byte = 1; byte <= output_bytes; ++byte) received.add(module::output(byte), 8);
  for (const canopen::PdoPlan& plan : {sent, received}) {
    if (plan.count == 0) continue;
    set_first(plan.communication(1), plan.direction == canopen::PdoDirection::sent_by_node
                                         ? canopen::transmit_pdo_identifier(1, node)
                                         : canopen::receive_pdo_identifier(1, node));
    set_first(plan.mapping(0), plan.count);
    for (std::uint8_t entry = 1; entry <= plan.count; ++entry) {
      set_first(plan.mapping(entry), canopen::mapping_word(plan.entries[entry - 1U]));
    }
  }
}

void ModuleObjects::lack_all(std::uint16_t index) {
  for (std::uint8_t subindex = 0; subindex <= canopen::cia401::most_bytes; ++subindex)
    lack({index, subindex});
}

}  // namespace flexrf
