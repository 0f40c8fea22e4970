#include "hal/modbus/link/interface/modbus_plan.hpp"

#include <algorithm>
#include <tuple>

namespace flexrf {
namespace {

std::size_t most_of(ModbusArea area, bool writing, std::size_t most_registers) {
  const bool bits = area == ModbusArea::coil || area == ModbusArea::discrete_input;
  if (bits) return writing ? 1968 : 2000;
  return std::min<std::size_t>(writing ? 123 : 125, most_registers);
}

// Reads go by poll group too; writes are sent when they change, whatever their group.
std::vector<std::size_t> sorted_by_address(const ModbusRegisterMap& map, bool writing) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < map.registers.size(); ++i) {
    if (writing ? map.registers[i].is_written() : map.registers[i].is_read()) order.push_back(i);
  }
  const auto key = [&](std::size_t i) {
    const ModbusRegister& entry = map.registers[i];
    return std::tuple(entry.area, writing ? ModbusPollGroup::fast : entry.poll_group, entry.address);
  };
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
  return order;
}

bool share_a_register(const ModbusRegister& one, const ModbusRegister& other) {
  return one.is_bit_of_register() && other.is_bit_of_register() && one.area == other.area &&
         one.address == other.address;
}

std::size_t place_all(const ModbusRegisterMap& map, bool writing, std::size_t most_registers,
                      ModbusPlan& plan) {
  std::vector<ModbusBlock>& blocks = writing ? plan.writes : plan.reads;
  std::uint16_t ModbusPlace::*const place = writing ? &ModbusPlace::output : &ModbusPlace::input;
  std::size_t words = 0;
  const ModbusRegister* before = nullptr;
  for (const std::size_t i : sorted_by_address(map, writing)) {
    const ModbusRegister& entry = map.registers[i];
    const ModbusPollGroup group = writing ? ModbusPollGroup::fast : entry.poll_group;
    const bool continues = !blocks.empty() && blocks.back().area == entry.area &&
                           blocks.back().group == group &&
                           (!writing || blocks.back().refreshed == entry.refreshed);
    if (continues && share_a_register(*before, entry)) {
      words -= 1;  // which has been counted
    } else {
      const bool joins =
          continues && blocks.back().address + blocks.back().count == entry.address &&
          blocks.back().count + std::size_t{entry.words()} <= most_of(entry.area, writing, most_registers);
      if (!joins)
        blocks.push_back(
            {entry.area, group, entry.address, 0, static_cast<std::uint16_t>(words), entry.refreshed});
      blocks.back().count = static_cast<std::uint16_t>(blocks.back().count + entry.words());
    }
    plan.places[i].*place = static_cast<std::uint16_t>(words);
    if (!writing) plan.places[i].read = static_cast<std::uint16_t>(blocks.size() - 1);
    words += entry.words();
    before = &entry;
  }
  return words;
}

}  // namespace

Status plan_requests(const ModbusRegisterMap& map, std::uint16_t most_registers, ModbusPlan& plan) {
  plan = {};
  for (const ModbusRegister& entry : map.registers) {
    if (entry.words() <= most_registers) continue;
    return Status::error(
        StatusCode::invalid_argument,
        "`%.*s` has %d registers, and a request may have %d: a value that is told in two parts may be "
        "of two times; raise most_registers",
        static_cast<int>(entry.name.size()), entry.name.data(), int{entry.words()}, int{most_registers});
  }
  plan.places.resize(map.registers.size());
  if (map.registers.size() > max_modbus_registers) {
    return Status::error(StatusCode::invalid_argument, "the register map has %zu registers, at most %zu fit",
                         map.registers.size(), max_modbus_registers);
  }
  const std::size_t inputs = place_all(map, false, most_registers, plan);
  const std::size_t outputs = place_all(map, true, most_registers, plan);
  if (inputs > max_modbus_input_words || outputs > max_modbus_output_words) {
    return Status::error(StatusCode::invalid_argument,
                         "the register map has %zu words to read and %zu to write, at most %zu and %zu fit",
                         inputs, outputs, max_modbus_input_words, max_modbus_output_words);
  }
  if (plan.reads.size() > max_modbus_reads) {
    return Status::error(StatusCode::invalid_argument,
                         "reading this register map takes %zu requests, at most %zu are possible: list the "
                         "registers between its scattered ones too, so that they can be read together",
                         plan.reads.size(), max_modbus_reads);
  }
  return {};
}

}  // namespace flexrf
